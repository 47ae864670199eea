#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Who drills in two bones of a knee, with what, and when they are done: makes the events of
/// tunnel_events.h about drills. A function of tools and rods alone, so that a replay tells the
/// same. The case must outlive it.
class DrillWatch {
 public:
  static constexpr std::size_t kBones = 2;
  using Bones = std::array<std::uint32_t, kBones>;  ///< kNoSubject: not asked for
  /// `widths_m`: of each instrument of the tray, what it drills; 0: it does not drill.
  DrillWatch(const Case& the_case, const Bones& bones, std::vector<double> widths_m, double tick_s,
             std::size_t hands);
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);
  /// Whether that bone was drilled since it was last taken, is free of drills for half a second
  /// and of pins: once.
  bool take_done(std::size_t bone);
  /// It may have changed: it counts as drilled once more.
  void look_again(std::size_t bone);
  /// Whether it was drilled since it was last taken: at the end.
  bool take_drilled(std::size_t bone);
  const MeshDistance& whole(std::size_t bone);

 private:
  struct Drilling {
    bool inside = false;  ///< the tip has been in the bone under power
    Vec3 inside_B = Vec3::Zero();
    Vec3 entered_B = Vec3::Zero();  ///< where it came into the bone
    double told_m = 0;              ///< how far beyond was told
  };
  struct Bone {
    std::optional<MeshDistance> whole;
    bool drilled = false, pinned = false, begun = false, told_free = false, told_deep = false;
    std::uint64_t busy_tick = 0;
    std::vector<Drilling> hands;
  };
  void look(std::size_t bone, std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
            std::vector<Event>& out);
  void begin(std::size_t bone, std::size_t hand, const ToolState& tool, std::vector<Event>& out);

  const Case* case_;
  Bones bones_;
  std::vector<double> widths_m_;
  double tick_s_;
  std::uint64_t stride_, now_ = 0;
  std::array<Bone, kBones> watched_;
};

}  // namespace osteon
