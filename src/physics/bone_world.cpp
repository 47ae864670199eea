#include "osteon/physics/bone_world.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "bullet_bodies.h"
#include "mass_properties.h"
#include "osteon/base/hash.h"
#include "spring.h"

namespace osteon {
namespace {

// Soft parts do not let a bone of the wrist go further; a spring alone would.
constexpr double kMaxShift = 0.020;
constexpr double kMaxTurn = 0.5;
// No hand pushes harder, and no bone is longer: what lies beyond is a fault and is not applied.
constexpr double kMaxForce = 1000;
constexpr double kMaxLever = 1.0;
// Steps after which the tool has surely answered to how a bone gave way.
constexpr double kAnswerSteps = 4;

// Force on a body and torque about its centre of mass.
struct Load {
  Vec3 force_W = Vec3::Zero();
  Vec3 torque_W = Vec3::Zero();
  bool touched = false;
  double lever2 = 0;  // largest squared lever, m^2
};

using Tools = std::span<const ToolState* const>;

void add_load(const ToolState& tool, std::size_t bone, const Vec3& p_WI, Load& load) {
  const std::size_t count = std::min<std::size_t>(tool.contact_count, kMaxContacts);
  for (std::size_t i = 0; i < count; ++i) {
    const Contact& contact = tool.contacts[i];
    if (contact.bone.index != bone) continue;
    const Vec3 force_W = -contact.force_on_tool_W;
    const Vec3 lever_W = contact.p_W - p_WI;
    // Written so that a NaN is refused.
    if (!(force_W.norm() <= kMaxForce && lever_W.norm() <= kMaxLever)) continue;
    load.force_W += force_W;
    load.torque_W += lever_W.cross(force_W);
    load.touched = true;
    load.lever2 = std::max(load.lever2, lever_W.squaredNorm());
  }
}

Load load_of(Tools tools, std::uint32_t epoch, std::size_t bone, const Vec3& p_WI) {
  Load load;
  for (const ToolState* tool : tools)
    if (tool->epoch == epoch) add_load(*tool, bone, p_WI, load);
  return load;
}

Vec3 half_extent(const Bone& bone, const Pose& X_IB) {
  Aabb box;
  for (const Hull& piece : bone.pieces)
    for (const Vec3& v : piece.vertices) box.include(X_IB * v);
  return box.empty() ? Vec3::Constant(0.005) : Vec3(0.5 * box.extent());
}

void add_to(Hasher& hasher, const ToolGuide& guide) {
  hasher.add(guide.on);
  if (!guide.on) return;
  hasher.add(guide.instrument);
  hasher.add(guide.bone);
  hasher.add(guide.p_B);
  hasher.add(guide.nhat_B);
  for (const double x : {guide.grip, guide.give_m_per_n, guide.stop_m}) hasher.add(x);
  hasher.add(guide.in_hole);
  hasher.add(guide.stops);
  if (guide.pulls) hasher.add(guide.pulls);
}

// Nothing where no fascia covers the tendons: what was recorded before there was any stays the
// same.
void add_fascia(Hasher& hasher, const GraftBenchState& bench) {
  bool covered = bench.slit != kFasciaOpen || bench.hurt != 0;
  for (const TendonOnBench& tendon : bench.tendons) covered = covered || !tendon.found;
  for (const BenchHand& hand : bench.hands) covered = covered || hand.lifts != 0 || hand.slits != 0;
  if (!covered) return;
  hasher.add(bench.slit);
  hasher.add(bench.hurt);
  for (const TendonOnBench& tendon : bench.tendons) hasher.add(tendon.found);
  for (const BenchHand& hand : bench.hands) {
    hasher.add(hand.slits);
    hasher.add(hand.lifts);
  }
}

void add_to(Hasher& hasher, const GraftBenchState& bench) {
  add_fascia(hasher, bench);
  for (const TendonOnBench& tendon : bench.tendons) {
    hasher.add(tendon.bands_cut);
    hasher.add(tendon.front_m);
    hasher.add(tendon.stripped);
    hasher.add(tendon.amputated);
    hasher.add(tendon.folds);
    hasher.add(tendon.scraped_m);
    hasher.add(tendon.stitches);
  }
  for (const BenchHand& hand : bench.hands) {
    for (const std::uint32_t x :
         {hand.instrument, hand.line, hand.carries, hand.over, hand.hangs, hand.scrapes})
      hasher.add(x);
    hasher.add(hand.grip);
    hasher.add(hand.front_m);
    hasher.add(hand.shut);
    hasher.add(hand.from_W);
  }
  for (const double x :
       {bench.passed_m, bench.refused_m, bench.loop_m, bench.tension_n, bench.creep_s})
    hasher.add(x);
}

void add_to(Hasher& hasher, const GraftPlacingState& placing) {
  hasher.add(static_cast<std::uint8_t>(placing.phase));
  for (const PlacingHand& hand : placing.hands) {
    hasher.add(hand.instrument);
    hasher.add(static_cast<std::uint8_t>(hand.line));
    hasher.add(hand.grip);
    hasher.add(hand.shut);
    hasher.add(hand.from_m);
  }
  hasher.add(placing.end_W);
  for (const std::uint32_t x : {placing.holder, placing.lost, placing.let_go_early}) hasher.add(x);
  for (const double x :
       {placing.pin_m, placing.drawn_m, placing.pull_n, placing.most_pull_n, placing.gap_m})
    hasher.add(x);
  if (placing.tension_n == 0 && placing.cycles_before == 0 && placing.screw.screws == 0) return;
  const PlacingScrew& screw = placing.screw;
  for (const std::uint32_t x : {placing.cycles_before, screw.screws, screw.cycles}) hasher.add(x);
  hasher.add(screw.p_B);
  hasher.add(screw.out_B);
  hasher.add(screw.done);
  for (const double x : {placing.tension_n, screw.width_m, screw.length_m, screw.in_m,
                         screw.tension_n, screw.flexion_deg})
    hasher.add(x);
}

// A graft that was handed over, or is being.
void add_order(Hasher& hasher, const GraftPlacingState& placing) {
  hasher.add(placing.ordered);
  hasher.add(placing.told);
  for (const double x : placing.numbers) hasher.add(x);
  if (placing.on)
    for (const double x : placing_numbers(placing.plan)) hasher.add(x);
}

void add_to(Hasher& hasher, const BendState& bend) {
  hasher.add(bend.wanted_deg);
  hasher.add(bend.now_deg);
  hasher.add(bend.straight);
  hasher.add(bend.cycles);
}

// What was told is in the digest, and with it all that follows from the loads.
void add_to(Hasher& hasher, const KneeExamState& exam) {
  hasher.add(exam.on);
  hasher.add(exam.told);
  hasher.add(exam.digest);
  for (const double x : exam.wanted) hasher.add(x);
  for (const double x : exam.now) hasher.add(x);
}

void add_to(Hasher& hasher, const WaterState& water) {
  for (const double x : {water.pump_pa, water.outlet_open, water.pressure_pa, water.blood,
                         water.debris, water.suction, water.bleeding_m3_s, water.debris_m3_s,
                         water.removed_m3, water.vascular_m3, water.opened_m3})
    hasher.add(x);
  for (const Wound& wound : water.wounds) {
    hasher.add(wound.soft);
    if (wound.soft == kNoWound) continue;
    hasher.add(wound.bone.index);
    hasher.add(wound.p_B);
    hasher.add(wound.open_m2);
  }
}

// A place in a list counts: which is the next that is free follows from it.
void add_to(Hasher& hasher, std::size_t hand, const InsideList& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Inside& one = list[i];
    if (one.kind == SubjectKind::kNothing) continue;
    hasher.add(hand);
    hasher.add(i);
    hasher.add(static_cast<std::uint8_t>(one.kind));
    hasher.add(one.subject);
    hasher.add(one.first_step);
    hasher.add(one.last_step);
    hasher.add(one.deepest_m);
  }
}

bool leads(const BoneSnapshot& snapshot) {
  return std::any_of(snapshot.guides.begin(), snapshot.guides.end(),
                     [](const ToolGuide& guide) { return guide.on; });
}

}  // namespace

std::uint64_t hash_of(const BoneSnapshot& snapshot) {
  Hasher hasher;
  hasher.add(snapshot.step);
  hasher.add(snapshot.time_s);
  hasher.add(snapshot.epoch);
  hasher.add(snapshot.count);
  for (std::uint32_t i = 0; i < snapshot.count; ++i) {
    hasher.add(snapshot.bones[i].X_WB);
    hasher.add(snapshot.bones[i].v_W);
    hasher.add(snapshot.bones[i].w_W);
  }
  // The rods themselves are in the state of what is carved.
  if (leads(snapshot))
    for (const ToolGuide& guide : snapshot.guides) add_to(hasher, guide);
  if (snapshot.bench.on) add_to(hasher, snapshot.bench);
  if (snapshot.placing.on) add_to(hasher, snapshot.placing);
  if (snapshot.placing.ordered || snapshot.placing.told > 0) add_order(hasher, snapshot.placing);
  if (snapshot.bend.on) add_to(hasher, snapshot.bend);
  if (snapshot.exam.told > 0) add_to(hasher, snapshot.exam);
  if (snapshot.water.on && snapshot.water.hashed) add_to(hasher, snapshot.water);
  for (std::size_t h = 0; h < snapshot.inside.size(); ++h) add_to(hasher, h, snapshot.inside[h]);
  return hasher.value();
}

/// The snapshot is the whole state: each step starts from it, so that a restored world goes on with
/// the same bits. Bullet holds nothing from one step to the next.
struct BoneWorld::Impl {
  // What a bone is, and where its springs pull it.
  struct Body {
    MassProperties whole, mass;
    BoneLoss loss;
    Pose X_IB;
    Pose X_WI_rest;
    Pose X_WB_rest;
    double damping_n_s_per_m = 0;
    Vec3 damping_nm_s = Vec3::Zero();
  };
  // Motion of the principal frame.
  struct BodyMotion {
    Pose X_WI;
    Vec3 v_W, w_W;
  };

  Impl(std::shared_ptr<const Case> c, const PhysicsParams& p);
  Body make_body(const Bone& bone) const;
  void set_mass(Body& body, const MassProperties& mass) const;
  BodyMotion motion_of(std::size_t i) const;
  void push(std::size_t i, Tools tools, BodyMotion& motion) const;
  void limit(std::size_t i, BodyMotion& motion) const;
  void store(std::size_t i, const BodyMotion& motion);
  void rest();
  void move(Tools tools);

  std::shared_ptr<const Case> the_case;
  PhysicsParams params;
  bool hold;
  std::vector<Body> bodies;
  std::vector<BodyMotion> motions;  // scratch of one step
  BulletBodies bullet;
  BoneSnapshot snapshot;
};

BoneWorld::Impl::Impl(std::shared_ptr<const Case> c, const PhysicsParams& p)
    : the_case(std::move(c)), params(p), hold(p.hold_bones) {
  assert(the_case->bones.size() <= kMaxBones);
  assert(params.step_s > 0);
  for (const Bone& bone : the_case->bones) {
    bodies.push_back(make_body(bone));
    bullet.add(bodies.back().mass, half_extent(bone, bodies.back().X_IB));
  }
  motions.resize(bodies.size());
  snapshot.count = static_cast<std::uint32_t>(bodies.size());
  rest();
}

BoneWorld::Impl::Body BoneWorld::Impl::make_body(const Bone& bone) const {
  assert(bone.mass_kg > 0);
  Body body;
  body.whole = mass_properties(bone.pieces, bone.mass_kg);
  body.X_WB_rest = bone.X_WB;
  set_mass(body, body.whole);
  return body;
}

void BoneWorld::Impl::set_mass(Body& body, const MassProperties& mass) const {
  body.mass = mass;
  body.X_IB = mass.X_BI.inverse();
  body.X_WI_rest = body.X_WB_rest * mass.X_BI;
  body.damping_n_s_per_m =
      damping_constant(mass.mass_kg, params.spring_n_per_m, params.damping_ratio);
  for (int i = 0; i < 3; ++i)
    body.damping_nm_s[i] =
        damping_constant(mass.moments[i], params.spring_nm_per_rad, params.damping_ratio);
}

void BoneWorld::Impl::rest() {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    snapshot.bones[i] = {bodies[i].X_WB_rest, Vec3::Zero(), Vec3::Zero()};
}

BoneWorld::Impl::BodyMotion BoneWorld::Impl::motion_of(std::size_t i) const {
  const BoneMotion& bone = snapshot.bones[i];
  const Pose X_WI = bone.X_WB * bodies[i].mass.X_BI;
  const Vec3 arm_W = X_WI.p - bone.X_WB.p;
  return {X_WI, bone.v_W + bone.w_W.cross(arm_W), bone.w_W};
}

// Velocities at the step's end under springs, dampers and the tool.
void BoneWorld::Impl::push(std::size_t i, Tools tools, BodyMotion& motion) const {
  const Body& body = bodies[i];
  const Load load = load_of(tools, snapshot.epoch, i, motion.X_WI.p);
  const Vec3 shift_W = motion.X_WI.p - body.X_WI_rest.p;
  const Vec3 turn_I = turn_between(body.X_WI_rest.q, motion.X_WI.q);
  const Quat q_IW = motion.X_WI.q.conjugate();
  const Vec3 torque_I = q_IW * load.torque_W;
  Vec3 w_I = q_IW * motion.w_W;
  const double yield = load.touched ? kAnswerSteps * params.step_s * params.contact_n_per_m : 0;
  for (int a = 0; a < 3; ++a) {
    motion.v_W[a] =
        spring_velocity(body.mass.mass_kg, params.spring_n_per_m, body.damping_n_s_per_m + yield,
                        params.step_s, shift_W[a], motion.v_W[a], load.force_W[a]);
    w_I[a] = spring_velocity(body.mass.moments[a], params.spring_nm_per_rad,
                             body.damping_nm_s[a] + yield * load.lever2, params.step_s, turn_I[a],
                             w_I[a], torque_I[a]);
  }
  motion.w_W = motion.X_WI.q * w_I;
}

// Stops a body at the end of its range.
void BoneWorld::Impl::limit(std::size_t i, BodyMotion& motion) const {
  const Pose& X_WI_rest = bodies[i].X_WI_rest;
  const Vec3 shift_W = motion.X_WI.p - X_WI_rest.p;
  const double length = shift_W.norm();
  if (length > kMaxShift) {
    const Vec3 outward = shift_W / length;
    motion.X_WI.p = X_WI_rest.p + kMaxShift * outward;
    motion.v_W -= std::max(0.0, motion.v_W.dot(outward)) * outward;
  }
  bool limited = false;
  motion.X_WI.q = limit_turn(X_WI_rest.q, motion.X_WI.q, kMaxTurn, &limited);
  if (limited) motion.w_W.setZero();
}

void BoneWorld::Impl::store(std::size_t i, const BodyMotion& motion) {
  BoneMotion& bone = snapshot.bones[i];
  bone.X_WB = motion.X_WI * bodies[i].X_IB;
  // Rounding of the products must not grow over a long session.
  bone.X_WB.q.normalize();
  // Of q and -q always the one near the rest pose's: a reader may compare components.
  if (bone.X_WB.q.dot(bodies[i].X_WB_rest.q) < 0) bone.X_WB.q.coeffs() *= -1.0;
  bone.w_W = motion.w_W;
  const Vec3 arm_W = bone.X_WB.p - motion.X_WI.p;
  bone.v_W = motion.v_W + motion.w_W.cross(arm_W);
}

void BoneWorld::Impl::move(Tools tools) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    motions[i] = motion_of(i);
    push(i, tools, motions[i]);
    bullet.set(i, motions[i].X_WI, motions[i].v_W, motions[i].w_W);
  }
  bullet.advance(params.step_s);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    motions[i].X_WI = bullet.pose(i);
    limit(i, motions[i]);
    store(i, motions[i]);
  }
}

BoneWorld::BoneWorld(std::shared_ptr<const Case> the_case, const PhysicsParams& params)
    : impl_(std::make_unique<Impl>(std::move(the_case), params)) {}
BoneWorld::~BoneWorld() = default;
BoneWorld::BoneWorld(BoneWorld&&) noexcept = default;

const BoneSnapshot& BoneWorld::step(const ToolState& tool) {
  const ToolState* const one = &tool;
  return step(std::span(&one, 1));
}

const BoneSnapshot& BoneWorld::step(std::span<const ToolState* const> tools) {
  if (!impl_->hold) impl_->move(tools);
  BoneSnapshot& snapshot = impl_->snapshot;
  ++snapshot.step;
  snapshot.time_s = static_cast<double>(snapshot.step) * impl_->params.step_s;
  return snapshot;
}

const BoneSnapshot& BoneWorld::snapshot() const { return impl_->snapshot; }

void BoneWorld::set_hold(bool hold) {
  impl_->hold = hold;
  if (hold) impl_->rest();
}

std::uint64_t BoneWorld::state_hash() const {
  Hasher hasher;
  hasher.add(hash_of(impl_->snapshot));
  hasher.add(static_cast<std::uint8_t>(impl_->hold));
  return hasher.value();
}

void BoneWorld::restore(const BoneSnapshot& snapshot, bool hold) {
  assert(snapshot.count == impl_->bodies.size());
  impl_->snapshot = snapshot;
  impl_->hold = hold;
}

void BoneWorld::go_back(const BoneSnapshot& kept, bool hold) {
  BoneSnapshot& now = impl_->snapshot;
  assert(kept.count == now.count);
  now.bones = kept.bones;
  ++now.epoch;
  impl_->hold = hold;
}

void BoneWorld::set_guides(const std::array<ToolGuide, kMaxHands>& guides, const GuideRods& rods) {
  impl_->snapshot.guides = guides;
  impl_->snapshot.rods = rods;
}

void BoneWorld::set_bench(const GraftBenchState& bench) { impl_->snapshot.bench = bench; }
void BoneWorld::set_placing(const GraftPlacingState& placing) { impl_->snapshot.placing = placing; }

void BoneWorld::set_bend(const BendState& bend) { impl_->snapshot.bend = bend; }

void BoneWorld::set_exam(const KneeExamState& exam) { impl_->snapshot.exam = exam; }

void BoneWorld::set_water(const WaterState& water) { impl_->snapshot.water = water; }

void BoneWorld::set_loose(const LooseBones& loose) { impl_->snapshot.loose = loose; }

void BoneWorld::set_softs(const SoftTold& told) { impl_->snapshot.softs = told; }

void BoneWorld::set_inside(std::size_t hand, const InsideList& list) {
  impl_->snapshot.inside[hand] = list;
}

bool BoneWorld::held() const { return impl_->hold; }
void BoneWorld::place(std::size_t bone, const BoneMotion& motion) {
  impl_->snapshot.bones[bone] = motion;
}
// The body's frame alone is Bullet's: what it weighs there moves nothing, see push.
void BoneWorld::set_loss(std::size_t bone, const BoneLoss& loss) {
  Impl::Body& body = impl_->bodies[bone];
  if (loss == body.loss) return;
  body.loss = loss;
  impl_->set_mass(body, less(body.whole, loss));
}
double BoneWorld::mass_kg(std::size_t bone) const { return impl_->bodies[bone].mass.mass_kg; }
void BoneWorld::ask_to_keep() { impl_->snapshot.saved_step = impl_->snapshot.step; }

}  // namespace osteon
