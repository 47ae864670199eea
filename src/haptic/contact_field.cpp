#include "contact_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "guide_pull.h"
#include "osteon/base/check.h"
#include "osteon/collide/carved_contact.h"
#include "osteon/scene/rings.h"
#include "osteon/scene/wide_field.h"
#include "rigid_motion.h"

namespace osteon {
namespace {

// A tool without rods is felt by fields as the balls around its pieces.
std::vector<Primitive> parts_to_field(const Tool& tool) {
  if (!tool.parts.empty()) return tool.parts;
  std::vector<Primitive> parts;
  for (const Capsule& rod : tool.rods) parts.push_back(make_rod(rod.p0, rod.p1, rod.radius));
  if (!parts.empty()) return parts;
  for (const ConvexBody& body : tool.bodies)
    parts.push_back(make_rod(body.center, body.center, body.radius));
  return parts;
}

// How far the field holds a rod off exactly.
double thickest(const DistanceField& field) { return field.data().outside_m - field.cell_m(); }

}  // namespace

ContactField::ContactField(const Case& the_case, const Tool& tool)
    : case_(the_case), tool_(tool), to_field_(parts_to_field(tool)) {
  measure_tool();
  cut_into_stretches();
  wide_.resize(case_.bones.size());
  cuts_.resize(case_.bones.size());
  for (std::uint32_t b = 0; b < case_.bones.size(); ++b) {
    first_pair_.push_back(static_cast<std::uint32_t>(pairs_.size()));
    if (case_.bones[b].field && !is_loose_ring(case_, b))
      add_field(b);
    else
      add_pieces(b);
  }
}

bool ContactField::can_be_cut() const {
  return std::any_of(cuts_.begin(), cuts_.end(), [](const CutField* cuts) { return cuts; });
}

void ContactField::set_cuts(std::span<const CutField* const> by_bone) {
  ++cuts_given_;
  std::copy_n(by_bone.begin(), std::min(by_bone.size(), cuts_.size()), cuts_.begin());
}

void ContactField::measure_tool() {
  const auto add = [&](const Vec3& middle, double radius) {
    // A little more than any support of it, rounding and all.
    piece_radius_.push_back((middle.norm() + radius) * (1 + 1e-9));
    tool_radius_ = std::max(tool_radius_, middle.norm() + radius);
  };
  if (whole()) {
    for (const Primitive& part : tool_.parts) add(part.middle, part.radius);
  } else {
    for (const ConvexBody& body : tool_.bodies) add(body.center, body.radius);
    for (const Primitive& part : to_field_)
      tool_radius_ = std::max(tool_radius_, part.middle.norm() + part.radius);
  }
}

// A tip is a ball about its origin. Of a whole instrument each part is looked about by itself, and
// a long one in stretches: what is near one of them is little.
void ContactField::cut_into_stretches() {
  if (!whole()) {
    stretches_.push_back({Vec3::Zero(), Vec3::Zero(), tool_radius_, kAllParts});
    return;
  }
  constexpr double kLongest = 0.020;
  for (std::uint32_t i = 0; i < tool_.parts.size(); ++i) {
    const Primitive& part = tool_.parts[i];
    const bool rod = part.kind == Primitive::Kind::kRod;
    const double radius = rod ? part.rod.radius : part.radius;
    const double length = (part.rod.p1 - part.rod.p0).norm();
    const double count = std::ceil(length / std::max(kLongest, 4 * radius));
    const int n = std::max(1, static_cast<int>(count));
    const Vec3 step = (part.rod.p1 - part.rod.p0) / n;
    for (int k = 0; k < n; ++k)
      stretches_.push_back({part.rod.p0 + k * step, part.rod.p0 + (k + 1) * step, radius, i});
  }
}

void ContactField::add_pieces(std::uint32_t bone) {
  // What jaws carry would push them apart: it is not felt.
  if (is_loose_ring(case_, bone)) return broad_phase_.add_bone(std::span<const ConvexBody>());
  const auto& bodies = case_.bones[bone].bodies;
  const auto parts = static_cast<std::uint32_t>(parts_beside(false));
  broad_phase_.add_bone(std::span<const ConvexBody>(bodies));
  for (std::uint32_t p = 0; p < bodies.size(); ++p)
    for (std::uint32_t t = 0; t < parts; ++t) pairs_.push_back({bone, p, t, false});
}

void ContactField::add_field(std::uint32_t bone) {
  const Bone& felt = case_.bones[bone];
  const bool thick = std::any_of(to_field_.begin(), to_field_.end(), [&](const Primitive& part) {
    return part.rod.radius > thickest(*felt.field);
  });
  if (thick) wide_[bone] = felt.wide ? felt.wide : make_wide_field(felt.mesh);
  demand(!thick || (wide_[bone] != nullptr && std::all_of(to_field_.begin(), to_field_.end(),
                                                          [&](const Primitive& part) {
                                                            return part.rod.radius <=
                                                                   thickest(*wide_[bone]);
                                                          })),
         "a tool is thicker than kThickestFelt_m, and a bone is felt as a field");
  broad_phase_.add_bone(felt.field->box());
  for (std::uint32_t t = 0; t < to_field_.size(); ++t) pairs_.push_back({bone, 0, t, true});
}

std::size_t ContactField::parts_beside(bool field) const {
  if (field) return to_field_.size();
  return whole() ? tool_.parts.size() : tool_.bodies.size();
}

ToolVicinity ContactField::vicinity() const {
  return ToolVicinity(broad_phase_, stretches_, tool_radius_);
}

// False when the list is full.
bool ContactField::add_found(const PieceRef& found, std::uint32_t part, CandidateList& out) const {
  const std::uint32_t start = first_pair_[found.bone];
  const bool field = pairs_[start].field;
  const auto parts = static_cast<std::uint32_t>(parts_beside(field));
  std::uint32_t& count = field ? out.field_count : out.count;
  const std::span<std::uint32_t> list =
      field ? std::span<std::uint32_t>(out.field) : std::span<std::uint32_t>(out.pair);
  const std::uint32_t from = part == kAllParts ? 0 : part;
  const std::uint32_t to = part == kAllParts ? parts : part + 1;
  for (std::uint32_t t = from; t < to; ++t) {
    const std::uint32_t pair = start + found.piece * parts + t;
    // A tip's pairs come in their order.
    std::uint32_t at = count;
    while (at > 0 && list[at - 1] > pair) --at;
    if (at > 0 && list[at - 1] == pair) continue;
    if (count == list.size()) return false;
    for (std::uint32_t i = count; i > at; --i) list[i] = list[i - 1];
    list[at] = pair;
    ++count;
  }
  return true;
}

bool ContactField::collect(const ToolReach& reach, std::span<const Pose> before_WB,
                           std::span<const Pose> now_WB, ToolVicinity& around,
                           CandidateList& out) const {
  out.count = 0;
  out.field_count = 0;
  const double about = whole() ? reach.reach_m + tool_radius_ : reach.reach_m;
  double moved_m = whole() ? reach.turn_rad * tool_radius_ : 0;
  for (std::size_t b = 0; b < now_WB.size(); ++b)
    if (!same_pose(before_WB[b], now_WB[b]))
      moved_m = std::max(moved_m, travel(before_WB[b], now_WB[b], reach.X_WT.p, about));
  const double margin = reach.reach_m + moved_m;
  around.look(reach.X_WT, now_WB, margin);
  std::array<PieceRef, kMaxCandidates> pieces;
  SweptSphere ball;
  std::uint32_t stretch = kAllParts;
  for (const StretchBesideBone& which : around.near()) {
    if (which.stretch != stretch) ball = around.ball(which.stretch, reach.X_WT);
    stretch = which.stretch;
    const std::size_t found = around.query(which, ball, now_WB, margin, pieces);
    if (found > pieces.size()) return false;
    for (std::size_t i = 0; i < found; ++i)
      if (!add_found(pieces[i], stretches_[which.stretch].part, out)) return false;
  }
  return true;
}

bool ContactField::separate(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT, LpBasis& basis,
                            PartingPlane& out) const {
  const PiecePair& ids = pairs_[pair];
  const Pose X_BT = X_WB.inverse() * X_WT;
  if (ids.field) {
    Looks uncounted;
    return separate_field(pair, X_BT, uncounted, {}, out);
  }
  if (whole()) return separate_part(ids, X_BT, basis, out);
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

bool ContactField::separate_part(const PiecePair& ids, const Pose& X_BT, LpBasis& basis,
                                 PartingPlane& out) const {
  const ConvexBody& bone_body = case_.bones[ids.bone].bodies[ids.piece];
  const PrimitiveContact contact =
      primitive_contact(bone_body, tool_.parts[ids.tool_piece], X_BT, &basis);
  if (contact.status != LpStatus::kOptimal) return guess(ids, X_BT, out);
  out.nhat_BT_B = contact.nhat_AB_A;
  out.gap = contact.gap;
  out.p_B = contact.p_A;
  out.bone_support = contact.top_A;
  return true;
}

// Any direction in which the supports leave a gap parts the pieces.
bool ContactField::guess(const PiecePair& ids, const Pose& X_BT, PartingPlane& out) const {
  const ConvexBody& bone_body = case_.bones[ids.bone].bodies[ids.piece];
  const Vec3 apart = X_BT * middle_of(ids) - bone_body.center;
  const double distance = apart.norm();
  if (!(distance > 0)) return false;
  out.nhat_BT_B = apart / distance;
  out.bone_support = support(bone_body, out.nhat_BT_B);
  const Vec3 nhat_T = X_BT.q.conjugate() * out.nhat_BT_B;
  const double tool_lowest = out.nhat_BT_B.dot(X_BT.p) - support_against(ids, nhat_T);
  out.gap = tool_lowest - out.bone_support;
  out.p_B = bone_body.center + out.nhat_BT_B * bone_body.radius;
  return out.gap > 0;
}

Vec3 ContactField::middle_of(const PiecePair& ids) const {
  return whole() ? tool_.parts[ids.tool_piece].middle : tool_.bodies[ids.tool_piece].center;
}

// How far the tool's part reaches against n_T from the tool's origin.
double ContactField::support_against(const PiecePair& ids, const Vec3& n_T) const {
  if (ids.field) return support(to_field_[ids.tool_piece], -n_T);
  if (whole()) return support(tool_.parts[ids.tool_piece], -n_T);
  return support(tool_.bodies[ids.tool_piece], -n_T);
}

PrimitiveContact ContactField::meet_hole_end(const PiecePair& ids, const Pose& X_BT) const {
  const Vec3 n_T = X_BT.q.conjugate() * guide_->nhat_B;
  double tool_m = -std::numeric_limits<double>::infinity();
  for (const Primitive& part : to_field_) tool_m = std::max(tool_m, support(part, -n_T));
  return hole_end(*guide_, X_BT, support_against(ids, n_T), tool_m, kFarGap_m);
}

// What was kept counts as many looks as asking again would: a tick ends its search at the same
// place, whatever is kept.
PrimitiveContact ContactField::meet_field(std::uint32_t pair, const Pose& X_BT, Looks& looks,
                                          const Wanted& wanted) const {
  const PiecePair& ids = pairs_[pair];
  if (guide_ && guide_->bone == ids.bone) return meet_hole_end(ids, X_BT);
  if (!looks.before) return ask_field(ids, X_BT, looks, wanted);
  const CutField* cuts = cuts_[ids.bone];
  const std::uint64_t lost = (cuts_given_ << 48) + (cuts ? cuts->changes() : 0);
  const MetBefore::Question question{pair, lost, X_BT, wanted.far_m, wanted.low_m};
  if (const MetBefore::Answer* kept = looks.before->find(question)) {
    looks.asked += kept->looks;
    if (wanted.places && kept->places.count > 0) *wanted.places = kept->places;
    return kept->contact;
  }
  const std::uint32_t asked = looks.asked;
  if (wanted.places) wanted.places->looked_about = false;
  const PrimitiveContact contact = ask_field(ids, X_BT, looks, wanted);
  const LowPlaces places = wanted.places ? *wanted.places : LowPlaces();
  looks.before->keep(question, {contact, looks.asked - asked, places});
  return contact;
}

// What is thicker than the fine field's band is looked for in the wide one, whose cells are large;
// the fine one then tells how far the surface is.
PrimitiveContact ContactField::ask_field(const PiecePair& ids, const Pose& X_BT, Looks& looks,
                                         const Wanted& wanted) const {
  const DistanceField& uncut = *case_.bones[ids.bone].field;
  const CutField* cuts = cuts_[ids.bone];
  const FieldView fine(uncut, cuts, &looks.asked);
  const Primitive& part = to_field_[ids.tool_piece];
  const double far = whole() ? wanted.far_m : std::numeric_limits<double>::infinity();
  const bool thin = !(part.rod.radius > thickest(uncut));
  const bool rod = part.kind == Primitive::Kind::kRod;
  if (thin && !(rod && fine.is_carved()))
    return primitive_contact(fine, part, X_BT, far, wanted.places);
  const FieldView coarse = thin ? fine : FieldView(*wide_[ids.bone], cuts, &looks.asked);
  if (!fine.is_carved())
    return corrected(primitive_contact(coarse, part, X_BT, far, wanted.places), fine);
  const Capsule rod_B{X_BT * part.rod.p0, X_BT * part.rod.p1, part.rod.radius};
  const CapsuleContact met = carved_contact(coarse, fine, rod_B, wanted.far_m, wanted.low_m);
  return {met.status, met.gap, met.nhat_AB_A, met.p_A, 0};
}

// A coarse field's contact, its place on the surface looked for along the normal.
PrimitiveContact ContactField::corrected(PrimitiveContact found, const FieldView& fine) const {
  if (found.status != LpStatus::kOptimal || !(found.gap < kFarGap_m)) return found;
  for (int i = 0; i < 2; ++i) {
    const FieldSample at = fine.at(found.p_A);
    if (!at.near) break;
    found.gap += at.distance;
    found.p_A -= at.distance * found.nhat_AB_A;
  }
  return found;
}

bool ContactField::separate_field(std::uint32_t pair, const Pose& X_BT, Looks& looks,
                                  const Wanted& wanted, PartingPlane& out) const {
  const PrimitiveContact contact = meet_field(pair, X_BT, looks, wanted);
  if (contact.status != LpStatus::kOptimal) return false;
  out.nhat_BT_B = contact.nhat_AB_A;
  out.bone_support = contact.nhat_AB_A.dot(contact.p_A);
  out.gap = contact.gap;
  out.p_B = contact.p_A;
  return true;
}

double ContactField::gap(std::uint32_t pair, const Pose& X_BT, Looks& looks,
                         const Wanted& wanted) const {
  const PrimitiveContact contact = meet_field(pair, X_BT, looks, wanted);
  return contact.status == LpStatus::kOptimal ? contact.gap
                                              : std::numeric_limits<double>::quiet_NaN();
}

FreeHalfSpace ContactField::half_space(std::uint32_t pair, const PartingPlane& s, const Pose& X_WB,
                                       const Quat& q_WT) const {
  const Vec3 n_W = turned(X_WB.q, s.nhat_BT_B);
  const Vec3 n_T = turned(q_WT.conjugate(), n_W);
  const PiecePair& ids = pairs_[pair];
  const double skin = ids.field ? kFieldSkin : kSkin;
  return {n_W, s.bone_support + n_W.dot(X_WB.p) + support_against(ids, n_T) + skin};
}

// In half_space's order of operations: rounding then keeps c above that one's.
FreeHalfSpace ContactField::outer_half_space(std::uint32_t pair, const PartingPlane& s,
                                             const Pose& X_WB) const {
  const Vec3 n_W = turned(X_WB.q, s.nhat_BT_B);
  return {n_W, s.bone_support + n_W.dot(X_WB.p) + piece_radius_[pairs_[pair].tool_piece] + kSkin};
}

}  // namespace osteon
