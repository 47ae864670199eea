#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/collide/broad_phase.h"

namespace osteon {

/// A stretch of a tool short enough for its surroundings to be few, in Tool.
struct ToolStretch {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double radius = 0;
  std::uint32_t part = 0;
};

/// One stretch beside one bone.
struct StretchBesideBone {
  std::uint32_t stretch = 0;
  std::uint32_t bone = 0;
};

/// Which bones are about which stretches of a tool, from tick to tick: what is far from each other
/// is not looked at again before it may have come near (Verlet's list, Physical Review 159, 1967).
/// It changes what a look costs, never what it finds. For one caller at a time; allocates in its
/// constructor only.
class ToolVicinity {
 public:
  /// `stretches` and `broad_phase` must outlive this. `tool_radius`: of the tool about its origin.
  ToolVicinity(const BroadPhase& broad_phase, std::span<const ToolStretch> stretches,
               double tool_radius);

  /// Makes `near()` hold every stretch and bone that may come within `margin` of each other.
  void look(const Pose& X_WT, std::span<const Pose> X_WB, double margin);

  /// By stretch, then by bone.
  std::span<const StretchBesideBone> near() const { return near_; }

  /// The stretch at a pose of the tool.
  SweptSphere ball(std::uint32_t stretch, const Pose& X_WT) const;

  /// The pieces of one of `near()`, as BroadPhase::query has them. `ball`: its stretch now.
  std::size_t query(const StretchBesideBone& which, const SweptSphere& ball,
                    std::span<const Pose> X_WB, double margin, std::span<PieceRef> out);

 private:
  /// Beyond this, m, a stretch and a bone are far from each other.
  static constexpr double kFar = 0.002;

  double approach(const Pose& X_WT, std::span<const Pose> X_WB, double margin) const;
  void look_at_all(const Pose& X_WT, std::span<const Pose> X_WB, double margin);

  const BroadPhase& broad_phase_;
  std::span<const ToolStretch> stretches_;
  double tool_radius_;
  std::vector<NearPieces> pieces_;  ///< of each stretch
  std::vector<StretchBesideBone> near_;
  /// When all were looked at.
  Pose X_WT_;
  std::vector<Pose> X_WB_;
  double margin_ = 0;
  double spare_ = -1;  ///< m; what was far may come so much nearer; below 0: nothing is known
};

}  // namespace osteon
