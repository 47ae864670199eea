#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/physics/joint_water.h"
#include "osteon/procedure/sight_events.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Follows the water in a joint through an attempt and tells when a scope shows nothing: for want
/// of pressure, or for blood and debris. The water is that of the session, with the pump as the
/// user has set it: a replay tells the same.
class WaterWatch {
 public:
  /// `looks`: of each instrument of the tray whether one looks through it. `by_portal`: one that is
  /// in no portal shows nothing of the joint.
  WaterWatch(const FluidJoint& joint, std::vector<char> looks, double tick_s,
             bool by_portal = false);
  /// None where the case holds no water or no instrument of the tray looks.
  static std::optional<WaterWatch> of(const Case& the_case, const std::vector<std::string>& tray,
                                      double tick_s);

  /// Adds the tick's events to `out`. Bones without water: nothing is told.
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);
  const ObscuredSight& sight() const { return sight_; }
  /// At the last look, with a scope in the joint.
  bool is_obscured_now() const { return was_obscured_; }

 private:
  static constexpr double kStep_s = 0.1;

  std::optional<std::size_t> looking(std::span<const ToolState* const> tools) const;
  void count(double now_s, bool obscured, const FluidState& state);

  FluidJoint joint_;
  std::vector<char> looks_;  // by place in the tray
  double tick_s_;
  bool by_portal_;
  std::uint64_t stride_;
  ObscuredSight sight_;
  bool was_obscured_ = false;
};

}  // namespace osteon
