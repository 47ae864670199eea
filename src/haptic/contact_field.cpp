#include "contact_field.h"

#include <algorithm>
#include <limits>

#include "osteon/collide/field_contact.h"
#include "rigid_motion.h"

namespace osteon {
namespace {

// A tool without rods is felt by fields as the balls around its pieces.
std::vector<Capsule> rods_of(const Tool& tool) {
  if (!tool.rods.empty()) return tool.rods;
  std::vector<Capsule> rods;
  for (const ConvexBody& body : tool.bodies)
    rods.push_back({body.center, body.center, body.radius});
  return rods;
}

Capsule placed(const Pose& X_BT, const Capsule& rod) {
  return {X_BT * rod.p0, X_BT * rod.p1, rod.radius};
}

}  // namespace

ContactField::ContactField(const Case& the_case, const Tool& tool)
    : case_(the_case), tool_(tool), rods_(rods_of(tool)) {
  for (const ConvexBody& body : tool.bodies) {
    // A little more than any support of it, rounding and all.
    piece_radius_.push_back((body.center.norm() + body.radius) * (1 + 1e-9));
    tool_radius_ = std::max(tool_radius_, body.center.norm() + body.radius);
  }
  for (const Capsule& rod : rods_)
    tool_radius_ = std::max({tool_radius_, rod.p0.norm() + rod.radius, rod.p1.norm() + rod.radius});
  for (std::uint32_t b = 0; b < case_.bones.size(); ++b) {
    first_pair_.push_back(static_cast<std::uint32_t>(pairs_.size()));
    if (felt_as_field(case_.bones[b]))
      add_field(b);
    else
      add_pieces(b);
  }
}

void ContactField::add_pieces(std::uint32_t bone) {
  const auto& bodies = case_.bones[bone].bodies;
  broad_phase_.add_bone(std::span<const ConvexBody>(bodies));
  for (std::uint32_t p = 0; p < bodies.size(); ++p)
    for (std::uint32_t t = 0; t < tool_.bodies.size(); ++t) pairs_.push_back({bone, p, t, false});
}

void ContactField::add_field(std::uint32_t bone) {
  broad_phase_.add_bone(case_.bones[bone].field->box());
  for (std::uint32_t t = 0; t < rods_.size(); ++t) pairs_.push_back({bone, 0, t, true});
}

// A rod thicker than the field's band would touch where nothing but a bound is known: it feels the
// pieces.
bool ContactField::felt_as_field(const Bone& bone) const {
  if (!bone.field) return false;
  const double most = bone.field->data().outside_m - bone.field->cell_m();
  return std::all_of(rods_.begin(), rods_.end(),
                     [most](const Capsule& rod) { return rod.radius <= most; });
}

bool ContactField::collect(const Vec3& p_W, double reach_m, std::span<const Pose> before_WB,
                           std::span<const Pose> now_WB, NearPieces& near,
                           CandidateList& out) const {
  double moved_m = 0;
  for (std::size_t b = 0; b < now_WB.size(); ++b)
    if (!same_pose(before_WB[b], now_WB[b]))
      moved_m = std::max(moved_m, travel(before_WB[b], now_WB[b], p_W, reach_m));
  std::array<PieceRef, kMaxCandidates> pieces;
  const SweptSphere ball{p_W, p_W, tool_radius_};
  const std::size_t found = broad_phase_.query(now_WB, ball, reach_m + moved_m, pieces, &near);
  out.count = 0;
  out.field_count = 0;
  if (found > pieces.size()) return false;
  for (std::size_t i = 0; i < found; ++i) {
    const std::uint32_t start = first_pair_[pieces[i].bone];
    const bool field = pairs_[start].field;
    const std::size_t tool_pieces = field ? rods_.size() : tool_.bodies.size();
    std::uint32_t& count = field ? out.field_count : out.count;
    if (count + tool_pieces > (field ? kMaxFields : kMaxCandidates)) return false;
    const std::size_t first = start + pieces[i].piece * tool_pieces;
    for (std::size_t t = 0; t < tool_pieces; ++t)
      (field ? out.field[count++] : out.pair[count++]) = static_cast<std::uint32_t>(first + t);
  }
  return true;
}

bool ContactField::separate(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT, LpBasis& basis,
                            PartingPlane& out) const {
  const PiecePair& ids = pairs_[pair];
  const Pose X_BT = X_WB.inverse() * X_WT;
  if (ids.field) return separate_field(ids, X_BT, out);
  const ConvexBody& bone_body = case_.bones[ids.bone].bodies[ids.piece];
  const ConvexBody& tool_body = tool_.bodies[ids.tool_piece];
  LpDepth depth = lp_depth(bone_body, tool_body, X_BT, &basis);
  if (depth.status != LpStatus::kOptimal) {
    basis = {};
    depth = lp_depth(bone_body, tool_body, X_BT, &basis);
  }
  if (depth.status != LpStatus::kOptimal) return guess(ids, X_BT, out);
  out.nhat_BT_B = depth.nhat_AB_A;
  out.gap = depth.gap;
  out.p_B = depth.p_A;
  out.bone_support = depth.top_A;
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

bool ContactField::separate_field(const PiecePair& ids, const Pose& X_BT, PartingPlane& out) const {
  const CapsuleContact contact =
      field_contact(*case_.bones[ids.bone].field, placed(X_BT, rods_[ids.tool_piece]));
  if (contact.status != LpStatus::kOptimal) return false;
  out.nhat_BT_B = contact.nhat_AB_A;
  out.bone_support = contact.nhat_AB_A.dot(contact.p_A);
  out.gap = contact.gap;
  out.p_B = contact.p_A;
  return true;
}

double ContactField::gap(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT) const {
  const PiecePair& ids = pairs_[pair];
  const Pose X_BT = X_WB.inverse() * X_WT;
  const CapsuleContact contact =
      field_contact(*case_.bones[ids.bone].field, placed(X_BT, rods_[ids.tool_piece]));
  return contact.status == LpStatus::kOptimal ? contact.gap
                                              : std::numeric_limits<double>::quiet_NaN();
}

FreeHalfSpace ContactField::half_space(std::uint32_t pair, const PartingPlane& s, const Pose& X_WB,
                                       const Quat& q_WT) const {
  const Vec3 n_W = X_WB.rotate(s.nhat_BT_B);
  const Vec3 n_T = q_WT.conjugate() * n_W;
  const PiecePair& ids = pairs_[pair];
  if (ids.field) {
    const Capsule& rod = rods_[ids.tool_piece];
    const double rod_support = rod.radius - std::min(n_T.dot(rod.p0), n_T.dot(rod.p1));
    return {n_W, s.bone_support + n_W.dot(X_WB.p) + rod_support + kFieldSkin};
  }
  const double tool_support = support(tool_.bodies[ids.tool_piece], -n_T);
  return {n_W, s.bone_support + n_W.dot(X_WB.p) + tool_support + kSkin};
}

// In half_space's order of operations: rounding then keeps c above that one's.
FreeHalfSpace ContactField::outer_half_space(std::uint32_t pair, const PartingPlane& s,
                                             const Pose& X_WB) const {
  const Vec3 n_W = X_WB.rotate(s.nhat_BT_B);
  return {n_W, s.bone_support + n_W.dot(X_WB.p) + piece_radius_[pairs_[pair].tool_piece] + kSkin};
}

}  // namespace osteon
