#include "tool_vicinity.h"

#include <algorithm>
#include <limits>

#include "rigid_motion.h"

namespace osteon {
namespace {

// How far a point within `radius` of the origin of `before`'s frame goes at most, m. A turn moves
// it by 2 r sin(angle / 2), which is at most 2 r |q - q0| for unit quaternions.
double farthest_way(const Pose& before, const Pose& now, double radius) {
  const double turn = (now.q.coeffs() - before.q.coeffs()).norm();
  return (now.p - before.p).norm() + 2 * turn * radius;
}

}  // namespace

ToolVicinity::ToolVicinity(const BroadPhase& broad_phase, std::span<const ToolStretch> stretches,
                           double tool_radius)
    : broad_phase_(broad_phase),
      stretches_(stretches),
      tool_radius_(tool_radius),
      pieces_(stretches.size(), NearPieces(broad_phase)),
      X_WB_(broad_phase.bone_count()) {
  near_.reserve(stretches.size() * broad_phase.bone_count());
}

SweptSphere ToolVicinity::ball(std::uint32_t stretch, const Pose& X_WT) const {
  const ToolStretch& s = stretches_[stretch];
  return {X_WT * s.from, X_WT * s.to, s.radius};
}

// How much nearer than at the last look at all any stretch and any bone can be, and a margin reach,
// m: infinity where a bone alone goes too far, not a number where the tool's pose is none.
double ToolVicinity::approach(const Pose& X_WT, std::span<const Pose> X_WB, double margin) const {
  constexpr double kRounding = 1e-8;
  double most = 0;
  for (std::size_t b = 0; b < X_WB_.size(); ++b) {
    if (same_pose(X_WB_[b], X_WB[b])) continue;
    const double about = (X_WT.p - X_WB_[b].p).norm() + tool_radius_;
    const double way = farthest_way(X_WB_[b], X_WB[b], about);
    if (!(way < spare_)) return std::numeric_limits<double>::infinity();
    most = std::max(most, way);
  }
  return most + farthest_way(X_WT_, X_WT, tool_radius_) + (margin - margin_) + kRounding;
}

void ToolVicinity::look(const Pose& X_WT, std::span<const Pose> X_WB, double margin) {
  if (spare_ >= 0 && approach(X_WT, X_WB, margin) < spare_) return;
  look_at_all(X_WT, X_WB, margin);
}

// A query makes the stretch's own list know how far the bone is.
void ToolVicinity::look_at_all(const Pose& X_WT, std::span<const Pose> X_WB, double margin) {
  near_.clear();
  spare_ = std::numeric_limits<double>::infinity();
  for (std::uint32_t s = 0; s < stretches_.size(); ++s) {
    const SweptSphere swept = ball(s, X_WT);
    for (std::uint32_t b = 0; b < X_WB_.size(); ++b) {
      broad_phase_.query_bone(b, X_WB[b], swept, margin, {}, 0, &pieces_[s]);
      const double spare = BroadPhase::spare(pieces_[s], b, X_WB[b], swept, margin);
      if (spare < kFar)
        near_.push_back({s, b});
      else
        spare_ = std::min(spare_, spare);
    }
  }
  X_WT_ = X_WT;
  std::copy_n(X_WB.begin(), X_WB_.size(), X_WB_.begin());
  margin_ = margin;
}

std::size_t ToolVicinity::query(const StretchBesideBone& which, const SweptSphere& ball,
                                std::span<const Pose> X_WB, double margin,
                                std::span<PieceRef> out) {
  return broad_phase_.query_bone(which.bone, X_WB[which.bone], ball, margin, out, 0,
                                 &pieces_[which.stretch]);
}

}  // namespace osteon
