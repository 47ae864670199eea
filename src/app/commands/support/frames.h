#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// Writes a session's pictures, frame_000001.png and on, without a window. One thread.
class FrameWriter {
 public:
  /// Makes the folder when it is missing. `view` defaults to the dorsal one.
  static Result<FrameWriter> create(const Case& the_case, const std::filesystem::path& folder);

  /// Call once a tick; draws every 33 ms of simulated time. Stops at the first failure.
  void add(const ToolState& tool, const BoneSnapshot& bones);
  const std::optional<Error>& failure() const { return failure_; }

 private:
  FrameWriter(OffscreenContext context, Renderer renderer, ViewState view,
              std::filesystem::path folder);

  OffscreenContext context_;
  Renderer renderer_;
  ViewState view_;
  std::filesystem::path folder_;
  std::uint64_t written_ = 0;
  std::optional<Error> failure_;
};

}  // namespace osteon
