#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "xray/phantoms.h"

namespace osteon::testing {

/// A case of one ball at the origin.
inline std::shared_ptr<const Case> a_ball() {
  auto made = std::make_shared<Case>();
  made->name = "ball";
  Bone bone;
  bone.name = "ball";
  bone.mesh = testing_xray::ball(Vec3::Zero(), 0.010, 24);
  made->bones.push_back(std::move(bone));
  return made;
}

/// A tool that goes across the ball in a second.
inline ToolState tool_across_ball(std::uint64_t tick) {
  ToolState tool;
  tool.tick = tick;
  tool.time_s = 0.001 * static_cast<double>(tick);
  tool.X_WP.p = Vec3(0.03 * tool.time_s - 0.015, 0, 0.012);
  tool.X_WD = tool.X_WP;
  return tool;
}

}  // namespace osteon::testing
