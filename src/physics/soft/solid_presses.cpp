#include "soft/solid_presses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/collide/field_contact.h"

namespace osteon {
namespace {

// A part so near may touch before physics has looked again, even at 1 m/s.
constexpr double kSolidNear_m = 0.003;
constexpr double kLookedAt_m = 2 * kSolidNear_m;
// A part that has gone so deep has left the solid behind.
constexpr double kSolidDeepest_m = 0.02;
constexpr double kStride_m = 0.0002;  // beyond what a gap allows: thinner than any edge
constexpr int kStrides = 24;
// Parts of one tool that press so near to one another are one push: the deeper counts.
constexpr double kOnePush_m = 0.004, kOneWay = 0.5;
// So deep in another part a part has no surface. Ends that share a face are both felt.
constexpr double kInsidePart_m = 0.00005;

RoundBox shifted_part(const RoundBox& part, const Vec3& by) {
  RoundBox out = part;
  out.rod.p0 += by;
  out.rod.p1 += by;
  out.X.p += by;
  return out;
}

bool is_by(const Aabb& box, const RoundBox& part) {
  for (Eigen::Index k = 0; k < 3; ++k)
    if (lowest(part, Vec3::Unit(k)) > box.hi[k] + kSolidNear_m ||
        highest(part, Vec3::Unit(k)) < box.lo[k] - kSolidNear_m)
      return false;
  return true;
}

// Symbols: o, from the part to the place outside; g and n, gap and normal there; the plane of the
// surface there allows every o' with n.o' >= n.o - g. Each stride goes towards the shortest such
// o', by no more than the gap and a little: less than the part's place could pass through an edge
// by. Ends at the shortest o of one plane, or after so many strides on the way to it.
// What is farther than `far_m` from the surface is not looked for.
CapsuleContact lead_outside(const FieldView& field, const RoundBox& part, Vec3& o, double far_m) {
  CapsuleContact c = round_contact(field, shifted_part(part, o), far_m);
  for (int i = 0; i < kStrides && c.status == LpStatus::kOptimal; ++i) {
    const Vec3& n = c.nhat_AB_A;
    const Vec3 shortest = std::max(0.0, n.dot(o) - c.gap) * n;
    const Vec3 way = shortest - o;
    const double length = way.norm(), stride = std::max(c.gap, 0.0) + kStride_m;
    if (length < 1e-7) break;
    o += std::min(1.0, stride / length) * way;
    c = round_contact(field, shifted_part(part, o), far_m);
  }
  return c;
}

// How far a place is from what a part fills; negative: inside of it.
double outside_of(const RoundBox& part, const Vec3& p) {
  const AxisPoints near = nearest_on_cores(round_box(Capsule{p, p, 0}), part);
  return (near.a - near.b).norm() - part.rod.radius;
}

// Whether it is another part of the tool that presses the same solid.
bool presses_too(const SolidNear& other, const SolidNear& near) {
  return other.touching && !other.barred && other.contact.solid == near.contact.solid &&
         other.contact.part != near.contact.part;
}

double along_of(const Capsule& part, const Vec3& p_axis) {
  const Vec3 way = part.p1 - part.p0;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp((p_axis - part.p0).dot(way) / square, 0.0, 1.0) : 0;
}

}  // namespace

bool SolidPresses::place(std::size_t solid, const BoneSnapshot& bones) {
  X_WB_[solid] = bones.bones[solids_[solid].bone.index].X_WB;
  return is_finite(X_WB_[solid]);
}

RoundBox SolidPresses::in_bone(std::size_t solid, const SolidHand& hand, std::size_t part) const {
  return placed(X_WB_[solid].inverse() * hand.tool->X_WP, hand.parts[part]);
}

Vec3 SolidPresses::middle(const SolidNear& near, const SolidHand& hand) const {
  return middle_of(in_bone(near.contact.solid, hand, near.contact.part));
}

// Whether the place of a part that would touch lies inside another part of the tool, which presses
// the same solid another way: no surface of the tool is there, and what the other part has pressed
// aside is not in its way.
bool SolidPresses::is_covered(const SolidHandState& state, const SolidNear& near,
                              const SolidHand& hand, const Vec3& place_B,
                              const Vec3& nhat_B) const {
  return std::any_of(state.near.begin(), state.near.begin() + state.count, [&](const auto& other) {
    return presses_too(other, near) && !(other.contact.nhat_B.dot(nhat_B) > kOneWay) &&
           outside_of(in_bone(other.contact.solid, hand, other.contact.part), place_B) <
               -kInsidePart_m;
  });
}

// False: the part has gone.
bool SolidPresses::keep(SolidNear& near, const SolidHand& hand, const SolidHandState& state) const {
  SolidContact& contact = near.contact;
  if (hand.lifted >> contact.part & 1 || hand.held == contact.solid) return false;
  const FieldView field = view(contact.solid);
  const RoundBox part = in_bone(contact.solid, hand, contact.part);
  // Of a long shaft the stretch by the solid alone is looked at, and so the more closely.
  const double far_m = covered_wait_ ? kLookedAt_m : std::numeric_limits<double>::infinity();
  Vec3 o = near.barred ? Vec3(Vec3::Zero()) : Vec3(near.outside_B - middle_of(part));
  const CapsuleContact c =
      near.barred ? round_contact(field, part, far_m) : lead_outside(field, part, o, far_m);
  if (c.status != LpStatus::kOptimal) return false;
  near.deep_m = c.nhat_AB_A.dot(o) - c.gap;
  if (near.deep_m < -kSolidNear_m) return false;
  const bool begins = near.deep_m > 0 && !near.touching;
  near.touching = near.deep_m > 0;
  near.barred = near.touching && (near.barred || near.deep_m > kSolidDeepest_m);
  if (begins && covered_wait_ && !near.barred)
    near.barred =
        is_covered(state, near, hand, c.p_axis_A - o - part.rod.radius * c.nhat_AB_A, c.nhat_AB_A);
  near.slid_B = middle_of(part) + o - near.outside_B;
  near.outside_B = middle_of(part) + o;
  near.entered_m = std::clamp(near.entered_m, 0.0, std::max(0.0, near.deep_m));
  contact.p_B = c.p_A;
  if (near.entered_m > 0) contact.p_B -= near.entered_m * c.nhat_AB_A;
  contact.nhat_B = c.nhat_AB_A;
  const RoundBox there = shifted_part(part, o);
  if (part.is_box)
    contact.core = there.X.inverse() * c.p_axis_A;
  else
    contact.along = along_of(there.rod, c.p_axis_A);
  return true;
}

void SolidPresses::seek(SolidHandState& state, const SolidHand& hand, std::size_t solid) const {
  const FieldView field = view(solid);
  const Pose X_BT = X_WB_[solid].inverse() * hand.tool->X_WP;
  for (std::size_t part = 0; part < hand.parts.size(); ++part) {
    if (state.count == kMaxSolidContacts) return;
    const auto is_it = [&](const SolidNear& near) {
      return near.contact.solid == solid && near.contact.part == part;
    };
    if (hand.lifted >> part & 1) continue;
    if (std::any_of(state.near.begin(), state.near.begin() + state.count, is_it)) continue;
    const RoundBox part_B = placed(X_BT, hand.parts[part]);
    if (!is_by(field.box(), part_B)) continue;
    const CapsuleContact c = round_contact(field, part_B, kSolidNear_m);
    if (c.status != LpStatus::kOptimal || c.gap > kSolidNear_m) continue;
    SolidNear near;
    near.contact.solid = static_cast<std::uint32_t>(solid);
    near.contact.bone = solids_[solid].bone.index;
    near.contact.part = static_cast<std::uint32_t>(part);
    near.barred = c.gap < 0;
    near.outside_B = middle_of(part_B);
    if (!keep(near, hand, state)) continue;
    near.slid_B.setZero();
    state.near[state.count++] = near;
  }
}

void SolidPresses::follow(SolidHandState& state, const SolidHand& hand,
                          const SoftState& all) const {
  const SolidHandState before = state;  // each is covered by the others as they were, in any order
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < before.count; ++i) {
    SolidNear near = before.near[i];
    if (all.solid_lost[near.contact.solid] || !keep(near, hand, before)) continue;
    state.near[kept++] = near;
  }
  state.count = kept;
  for (std::size_t solid = 0; solid < solids_.size(); ++solid)
    if (!all.solid_lost[solid]) seek(state, hand, solid);
  for (std::uint32_t i = 0; i < state.count; ++i) {
    SolidNear& a = state.near[i];
    a.behind = false;
    for (std::uint32_t j = 0; j < state.count; ++j) {
      const SolidNear& b = state.near[j];
      if (i == j || b.barred || a.contact.solid != b.contact.solid ||
          (a.contact.p_B - b.contact.p_B).norm() > kOnePush_m ||
          !(a.contact.nhat_B.dot(b.contact.nhat_B) > kOneWay))
        continue;
      a.behind = a.behind || b.deep_m > a.deep_m || (b.deep_m == a.deep_m && j < i);
    }
  }
}

// A pull is a push against the way back.
std::optional<SoftPushes::One> SolidPresses::pull_on(std::size_t solid,
                                                     const SoftGrip& grip) const {
  if (grip.hold.of != SoftHold::Of::kSolid || grip.hold.part != solid || !(grip.force_n > 0))
    return {};
  return SoftPushes::One{grip.hold.part, grip.hold.p_B, grip.against_B, grip.force_n};
}

// Where parts of one tool press from two sides, each sends the solid towards the other, and their
// forces raise each other step by step. The other parts bring a place no nearer than the part is
// deep in it: at most twice the force of the part alone. Parts of two hands do the same to each
// other, without end where several press, or where what is left of a solid hangs on so little that
// its own way is bounded: what the other hand presses brings a place no nearer than it is deep.
double SolidPresses::others(const SolidNear& near, const SolidPush& push,
                            const SoftState& all) const {
  const PressedSolid& body = this->body(near.contact.solid);
  double sum = 0, by_own = 0, deepest_m = 0;
  for (const SolidHandState& hand : all.solid_hands) {
    const bool own = &near >= hand.near.data() && &near < hand.near.data() + hand.near.size();
    for (std::uint32_t i = 0; i < hand.count; ++i) {
      const SolidNear& other = hand.near[i];
      if (&other == &near || other.contact.solid != near.contact.solid || !(other.force_n > 0))
        continue;
      const SolidPush by = body.push_at(other.contact.p_B, other.contact.nhat_B);
      const double away = other.force_n * body.compliance(push, by);
      (own ? by_own : sum) += away;
      if (!own) deepest_m = std::max(deepest_m, other.deep_m);
    }
  }
  if (bounded_) sum = std::max(sum, -deepest_m);
  return with_pulls(sum, near, push, all) + std::max(by_own, std::min(0.0, -near.deep_m));
}

// What jaws pull comes no nearer than they have gone with it.
double SolidPresses::with_pulls(double sum, const SolidNear& near, const SolidPush& push,
                                const SoftState& all) const {
  const PressedSolid& body = this->body(near.contact.solid);
  for (const SoftGrip& grip : all.grips) {
    const auto pull = pull_on(near.contact.solid, grip);
    if (!pull) continue;
    const double away =
        pull->force_n * body.compliance(push, body.push_at(pull->p_B, pull->nhat_B));
    sum += bounded_ ? std::max(away, -grip.most_m) : away;
  }
  return sum;
}

void SolidPresses::press(SolidHandState& state, SolidHand& hand, const SoftState& all) const {
  for (std::uint32_t i = 0; i < state.count; ++i) {
    SolidNear& near = state.near[i];
    SolidContact& contact = near.contact;
    near.force_n = 0;
    if (near.barred || near.behind) continue;
    const PressedSolid& body = this->body(contact.solid);
    const SolidPush push = body.push_at(contact.p_B, contact.nhat_B);
    const double compliance = body.compliance(push, push);
    contact.stiffness_n_per_m = compliance > 0 ? 1 / compliance : 0;
    contact.others_m = others(near, push, all);
    const RoundBox part = in_bone(contact.solid, hand, contact.part);
    near.force_n = press_solid(contact, part, coupling_n_per_m_).force_n;
    hand.force_n[contact.solid] += near.force_n;
    hand.deep_m[contact.solid] = std::max(hand.deep_m[contact.solid], near.deep_m);
    if (near.force_n > 0) hand.p_W[contact.solid] = X_WB_[contact.solid] * contact.p_B;
  }
}

bool SolidPresses::is_asleep(std::size_t solid, const SoftState& all) const {
  for (const SolidHandState& hand : all.solid_hands)
    for (std::uint32_t i = 0; i < hand.count; ++i)
      if (hand.near[i].contact.solid == solid) return false;
  for (const SoftGrip& grip : all.grips)
    if (grip.hold.of == SoftHold::Of::kSolid && grip.hold.part == solid) return false;
  return true;
}

void SolidPresses::tell(const SolidHandState& state, BandContacts& contacts) const {
  for (std::uint32_t i = 0; i < state.count; ++i)
    if (!state.near[i].barred && !state.near[i].behind)
      contacts.solids[contacts.solid_count++] = state.near[i].contact;
}

SoftPushes SolidPresses::pushes(const SoftState& all) const {
  SoftPushes out;
  for (const SolidHandState& hand : all.solid_hands)
    for (std::uint32_t i = 0; i < hand.count; ++i) {
      const SolidNear& near = hand.near[i];
      const SolidContact& contact = near.contact;
      if (!(near.force_n > 0)) continue;
      double force_n = near.force_n;
      if (bodies_[contact.solid]) {  // of a whole one, which is drawn, what moves it as far
        const PressedSolid& whole = *solids_[contact.solid].body;
        const SolidPush push = whole.push_at(contact.p_B, contact.nhat_B);
        const double yields = whole.compliance(push, push);
        if (yields > 0 && contact.stiffness_n_per_m > 0)
          force_n /= yields * contact.stiffness_n_per_m;
      }
      out.all[out.count++] = {contact.solid, contact.p_B, contact.nhat_B, force_n};
    }
  for (const SoftGrip& grip : all.grips)
    if (const auto pull = pull_on(grip.hold.part, grip)) out.all[out.count++] = *pull;
  return out;
}

}  // namespace osteon
