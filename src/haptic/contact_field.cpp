#include "contact_field.h"

#include <algorithm>

#include "rigid_motion.h"

namespace osteon {
ContactField::ContactField(const Case& the_case, const Tool& tool) : case_(the_case), tool_(tool) {
  for (const ConvexBody& body : tool.bodies)
    tool_radius_ = std::max(tool_radius_, body.center.norm() + body.radius);
  for (std::uint32_t b = 0; b < case_.bones.size(); ++b) {
    const auto& bodies = case_.bones[b].bodies;
    broad_phase_.add_bone(std::span<const ConvexBody>(bodies));
    first_pair_.push_back(static_cast<std::uint32_t>(pairs_.size()));
    for (std::uint32_t p = 0; p < bodies.size(); ++p)
      for (std::uint32_t t = 0; t < tool.bodies.size(); ++t) pairs_.push_back({b, p, t});
  }
}

bool ContactField::collect(const Vec3& p_W, double reach_m, std::span<const Pose> before_WB,
                           std::span<const Pose> now_WB, CandidateList& out) const {
  double moved_m = 0;
  for (std::size_t b = 0; b < now_WB.size(); ++b)
    moved_m = std::max(moved_m, travel(before_WB[b], now_WB[b], p_W, reach_m));
  std::array<PieceRef, kMaxCandidates> near;
  const SweptSphere ball{p_W, p_W, tool_radius_};
  const std::size_t found = broad_phase_.query(now_WB, ball, reach_m + moved_m, near);
  const std::size_t tool_pieces = tool_.bodies.size();
  out.count = 0;
  if (found * tool_pieces > kMaxCandidates) return false;
  for (std::size_t i = 0; i < found; ++i) {
    const auto first = first_pair_[near[i].bone] + near[i].piece * tool_pieces;
    for (std::size_t t = 0; t < tool_pieces; ++t)
      out.pair[out.count++] = static_cast<std::uint32_t>(first + t);
  }
  return true;
}

bool ContactField::separate(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT, LpBasis& basis,
                            PartingPlane& out) const {
  const PiecePair& ids = pairs_[pair];
  const ConvexBody& bone_body = case_.bones[ids.bone].bodies[ids.piece];
  const ConvexBody& tool_body = tool_.bodies[ids.tool_piece];
  const Pose X_BT = X_WB.inverse() * X_WT;
  LpDepth depth = lp_depth(bone_body, tool_body, X_BT, &basis);
  if (depth.status != LpStatus::kOptimal) {
    basis = {};
    depth = lp_depth(bone_body, tool_body, X_BT, &basis);
  }
  if (depth.status != LpStatus::kOptimal) return guess(ids, X_BT, out);
  out.nhat_BT_B = depth.nhat_AB_A;
  out.gap = depth.gap;
  out.p_B = depth.p_A;
  const Vec3 nhat_T = X_BT.q.conjugate() * out.nhat_BT_B;
  out.bone_support = out.nhat_BT_B.dot(X_BT.p) - support(tool_body, -nhat_T) - depth.gap;
  return true;
}

// Any direction in which the supports leave a gap parts the pieces.
bool ContactField::guess(const PiecePair& ids, const Pose& X_BT, PartingPlane& out) const {
  const ConvexBody& bone_body = case_.bones[ids.bone].bodies[ids.piece];
  const ConvexBody& tool_body = tool_.bodies[ids.tool_piece];
  const Vec3 apart = X_BT * tool_body.center - bone_body.center;
  const double distance = apart.norm();
  if (!(distance > 0)) return false;
  out.nhat_BT_B = apart / distance;
  out.bone_support = support(bone_body, out.nhat_BT_B);
  const Vec3 nhat_T = X_BT.q.conjugate() * out.nhat_BT_B;
  const double tool_lowest = out.nhat_BT_B.dot(X_BT.p) - support(tool_body, -nhat_T);
  out.gap = tool_lowest - out.bone_support;
  out.p_B = bone_body.center + out.nhat_BT_B * bone_body.radius;
  return out.gap > 0;
}

FreeHalfSpace ContactField::half_space(std::uint32_t pair, const PartingPlane& s, const Pose& X_WB,
                                       const Quat& q_WT) const {
  const Vec3 n_W = X_WB.rotate(s.nhat_BT_B);
  const Vec3 n_T = q_WT.conjugate() * n_W;
  const double tool_support = support(tool_.bodies[pairs_[pair].tool_piece], -n_T);
  return {n_W, s.bone_support + n_W.dot(X_WB.p) + tool_support + kSkin};
}

}  // namespace osteon
