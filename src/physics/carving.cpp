#include "osteon/physics/carving.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutter_front.h"
#include "osteon/base/check.h"
#include "osteon/base/hash.h"
#include "osteon/carve/rbf_force.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

/// How a tool stands on a bone in one step.
struct Carving::Push {
  const ToolState* tool = nullptr;
  std::uint32_t bone = CarvingHand::kNoBone;  ///< that it presses most; kNoBone: it touches none
  Pose X_WB, X_BT;
  Vec3 force_B = Vec3::Zero();  ///< on the tool
  std::uint64_t tick = 0;       ///< of the first hand
};

namespace {

constexpr double kSkin_m = 5e-6;      // that a proxy keeps from a field
constexpr double kBehind_m = 0.0003;  // pulled back so far, the drill is not at the hole's end
constexpr double kSlid_m = 0.0005;    // slid off so far sideways, it begins anew
constexpr double kBeyond_m = 0.001;   // gone on so far through nothing, it begins anew
constexpr double kStep_s = 0.002;
constexpr std::uint32_t kRestSteps = 50;  // without a cut: it has stopped
constexpr std::uint32_t kPlungeSteps = 250;
constexpr double kDeepEnough_m = 0.001;  // a shallower hole has no far side
constexpr double kLeastFacing = 0.2;  // of what cuts on one side: so far it must look at the bone
constexpr double kBladeFastest_m_per_s = 0.02;
constexpr double kFastestByHand_rev_per_s = 4;  // also after a while in the air
constexpr double kBurrFastest_m_per_s = 0.02;
constexpr double kBurrLead_m = 1e-4;
constexpr std::size_t kMostEvents = 32;  // of a step; no step has so many

Pose moved_along(const Pose& X, const Vec3& way) { return {X.p + way, X.q}; }
Vec3 back_of(const Pose& X) { return X.q * Vec3::UnitZ(); }

using Way = CarvingTool::Way;
bool needs_power(Way way) { return way == Way::kDrill || way == Way::kBurr; }
bool goes_forward(Way way) {
  return way == Way::kDrill || way == Way::kTwist || way == Way::kStrike;
}

// How far a tool is turned about its own axis from how the cutter stood, -pi to pi.
double twist_about(const Pose& X_BC, const Pose& X_BT) {
  const Quat q = X_BC.q.conjugate() * X_BT.q;
  return 2 * std::atan2(q.w() < 0 ? -q.z() : q.z(), std::abs(q.w()));
}

void add_to(Hasher& hasher, const CarvingHand& hand) {
  hasher.add(hand.bone);
  hasher.add(hand.X_BC);
  hasher.add(hand.drill.depth_m);
  hasher.add(hand.drill.turned_rev);
  hasher.add(hand.drill.was_cutting);
  for (const double x : {hand.due_m, hand.angle_rad, hand.most_torque_nm, hand.plunge_m})
    hasher.add(x);
  hasher.add(hand.idle);
  hasher.add(hand.since);
  hasher.add(hand.tissue);
  hasher.add(hand.twist_rad);
  for (const bool x : {hand.was_in, hand.skives, hand.jaw_open}) hasher.add(x);
  hasher.add(hand.out);
  hasher.add(hand.p_out);
  if (hand.loose > 0) hasher.add(hand.loose);
  if (hand.chatter.amplitude_m > 0) {
    for (const double x : {hand.chatter.amplitude_m, hand.chatter.frequency_hz}) hasher.add(x);
    hasher.add(hand.chatters_since);
  }
  if (!hand.in_hole && hand.rod == 0 && hand.lag_m == 0 && hand.grip == 0) return;
  for (const bool x : {hand.in_hole, hand.open}) hasher.add(x);
  for (const double x : {hand.lag_m, hand.grip}) hasher.add(x);
  hasher.add(hand.mouth_B);
  hasher.add(hand.rod);
  hasher.add(hand.instrument);
}

void add_to(Hasher& hasher, const LeftHole& hole) {
  hasher.add(hole.bone);
  hasher.add(hole.X_BC);
  hasher.add(hole.mouth_B);
  for (const double x : {hole.diameter_m, hole.lag_m}) hasher.add(x);
  hasher.add(hole.open);
}

void add_to(Hasher& hasher, const GuideRod& rod) {
  hasher.add(static_cast<std::uint8_t>(rod.kind));
  hasher.add(rod.bone);
  hasher.add(rod.X_BR);
  for (const double x : {rod.radius_m, rod.length_m, rod.in_bone_m}) hasher.add(x);
}

// How far behind a pose a cutter's whole front is free of bone.
double lag_of(const CarvedField& field, const CarvingTool& with, const Pose& X_BC) {
  constexpr double kStep_m = 1e-4, kMostSizes = 2;
  const Vec3 back = back_of(X_BC);
  double lag = 0;
  while (lag < kMostSizes * with.cutter.size_m &&
         look_before(field, with.cutter, with.pilot_m, moved_along(X_BC, (lag + kStep_m) * back))
                 .left() > 0)
    lag += kStep_m;
  return lag;
}

}  // namespace

bool operator==(const CarvingHand& a, const CarvingHand& b) {
  Hasher x, y;
  add_to(x, a);
  add_to(y, b);
  return x.value() == y.value();
}

CarvingHand anew(const CarvingHand& hand) {
  CarvingHand out;
  out.rod = hand.rod;
  out.grip = hand.grip;
  out.jaw_open = hand.jaw_open;
  out.instrument = hand.instrument;
  return out;
}

Carving::Carving(std::shared_ptr<const CarvingSetup> setup, std::size_t hands)
    : setup_(std::move(setup)), count_(std::min(hands, kMaxHands)) {
  for (const auto& bone : setup_->bones) {
    bones_.emplace_back();
    if (!bone) continue;
    auto field = CarvedField::make(bone, setup_->layers, setup_->most_blocks, setup_->air_m);
    demand(field.has_value(), "a setup for carving has layers that do not fit together");
    Bone& made = bones_.back();
    made.field = std::move(*field);
    made.loose = std::make_unique<LoosePieces>(*made.field);
    made.removed = std::make_unique<RemovedNodes>(*made.field);
    made.tissue_gone = std::make_unique<RemovedTissue>(*made.field);
    made.whole = whole_nodes(bone->bare() ? *bone->bare() : *bone).count;
  }
  changed_.reserve((kMaxHands + bones_.size()) * setup_->most_blocks);
  events_.reserve(kMostEvents);
}

const CarvedField* Carving::field(std::size_t bone) const {
  return bone < bones_.size() && bones_[bone].field ? &*bones_[bone].field : nullptr;
}

void Carving::tell(std::size_t hand, const Push& push, EventKind kind,
                   std::array<double, 3> values) {
  const CarvingHand& h = hands_[hand];
  const std::uint32_t bone = push.bone == CarvingHand::kNoBone ? h.bone : push.bone;
  if (events_.size() == kMostEvents) return;
  events_.push_back({push.tool->tick, kind, static_cast<std::uint8_t>(hand), SubjectKind::kBone,
                     bone, push.tool->X_WP.p, values});
}

void Carving::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                   double step_s) {
  changed_.clear();
  fallen_.clear();
  events_.clear();
  readouts_ = {};
  ++steps_;
  for (std::size_t h = 0; h < std::min(tools.size(), count_); ++h)
    step_hand(h, *tools[h], bones, step_s);
  if (steps_ % kLookEvery == 0) drop_pieces(tools);
}

void Carving::step_hand(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                        double step_s) {
  if (tool.tick == 0 || tool.epoch != bones.epoch || tool.instrument >= setup_->tray.size()) return;
  guides_[hand] = {};
  CarvingHand& h = hands_[hand];
  if (h.instrument == CarvingHand::kAnyInstrument) h.instrument = tool.instrument;
  if (h.instrument != tool.instrument) {
    // Who takes another instrument lets a pin go; who takes one beside a pin takes that.
    ToolState chuck = tool;
    chuck.jaw = 1;
    const auto pins = [&] {
      return std::count_if(rods_.begin(), rods_.end(),
                           [](const GuideRod& rod) { return rod.kind == GuideRod::Kind::kPin; });
    };
    const auto stood = pins();
    if (h.instrument < setup_->tray.size())
      if (const auto& before = setup_->tray[h.instrument]) {
        if (before->stays) follow_chuck(hand, *before, chuck, bones);
        if (h.in_hole) keep_hole(h, *before);
      }
    Push nothing;
    nothing.tool = &tool;
    run_smoothly(hand, nothing);
    h = {};
    h.instrument = tool.instrument;
    chuck.jaw = 0;
    h.jaw_open = true;
    const bool let_go = pins() != stood;  // what was let go is not what is taken
    if (const auto& now = setup_->tray[tool.instrument]; !let_go && now && now->stays)
      follow_chuck(hand, *now, chuck, bones);
    h.jaw_open = false;
  }
  cut_with(hand, tool, bones, step_s);
  publish(hand, tool, bones);
}

void Carving::cut_with(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                       double step_s) {
  const auto& with = setup_->tray[tool.instrument];
  CarvingHand& h = hands_[hand];
  if (!with) {
    if (tool.instrument < setup_->aimers.size() && setup_->aimers[tool.instrument])
      follow_aimer(hand, *setup_->aimers[tool.instrument], tool, bones);
    return;
  }
  if (with->stays) follow_chuck(hand, *with, tool, bones);
  if (with->stays && h.jaw_open) return slide_on_pin(hand, tool, bones);
  if (goes_forward(with->way)) leave_hole(hand, *with, tool, bones);
  if (with->way == Way::kDrill) {
    follow_rods(hand, *with, tool, bones);
    come_back(hand, *with, tool, bones);
  }
  Push push;
  push.tool = &tool;
  // The bone that is pressed most; of equals the first.
  double most = 0;
  for (std::uint32_t b = 0; b < bones_.size() && b < bones.count; ++b) {
    if (!bones_[b].field) continue;
    Vec3 force_W = Vec3::Zero();
    for (std::uint32_t i = 0; i < tool.contact_count; ++i)
      if (tool.contacts[i].bone.index == b) force_W += tool.contacts[i].force_on_tool_W;
    if (!(force_W.norm() > most)) continue;
    most = force_W.norm();
    push.bone = b;
    push.force_B = bones.bones[b].X_WB.q.conjugate() * force_W;
  }
  const std::uint32_t at = push.bone == CarvingHand::kNoBone ? h.bone : push.bone;
  if (at < bones.count) {
    push.X_WB = bones.bones[at].X_WB;
    push.X_BT = push.X_WB.inverse() * tool.X_WP;
  }
  if (with->way == Way::kBite) {
    for (std::uint32_t b = 0; b < bones_.size() && b < bones.count; ++b)
      if (bones_[b].field) bite(hand, *with, tool, bones.bones[b].X_WB.inverse() * tool.X_WP, b);
    h.jaw_open = tool.jaw > 0.5 || (h.jaw_open && tool.jaw > 0.1);
    return;
  }
  const bool off = needs_power(with->way) && !(tool.power > 0);
  if (off || push.bone == CarvingHand::kNoBone) return rest(hand, push);
  if (with->way == Way::kStrike)
    strike(hand, *with, push, step_s);
  else if (goes_forward(with->way))
    drill(hand, *with, push, step_s);
  else
    burr(hand, *with, push, step_s);
}

void Carving::begin(std::size_t hand, const CarvingTool& with, const Push& push) {
  CarvingHand& h = hands_[hand];
  run_smoothly(hand, push);
  h = anew(h);
  h.bone = push.bone;
  const Vec3 back = back_of(push.X_BT);
  h.X_BC = moved_along(push.X_BT, (CarvingSetup::kSlack_m - kSkin_m) * back);
  h.mouth_B = h.X_BC.p;
  h.since = steps_;
  const double size = push.force_B.norm();
  if (size > 0) h.angle_rad = std::acos(std::clamp(push.force_B.dot(back) / size, -1.0, 1.0));
  // A tip that stands in a hole is held by it, and so is one whose hole goes on before it.
  const CarvedField& field = *bones_[push.bone].field;
  const auto is_gone = [&](const Vec3& p_B) {
    return !was_outside(field, p_B) && !tissue_at(field, p_B);
  };
  const double start = setup_->table.start_depth_m + field.grid().cell_m;
  if (is_gone(push.X_BT.p + 0.5 * with.cutter.size_m * back) || is_gone(push.X_BT.p - start * back))
    h.drill.depth_m = setup_->table.start_depth_m;
  if (with.way == Way::kDrill) h.lag_m = lag_of(field, with, h.X_BC);
}

Pose Carving::cutter_pose(const CarvingHand& h) const {
  return moved_along(h.X_BC, h.lag_m * back_of(h.X_BC));
}

bool Carving::remove(std::size_t hand, const Cutter& cutter, const Pose& from_B, const Pose& to_B) {
  const std::uint32_t bone = hands_[hand].bone;
  CarvedField& field = *bones_[bone].field;
  const std::uint64_t before = field.step();
  const CarveStep did = field.cut(cutter, from_B, to_B);
  full_ = full_ || (did.status & CarveStep::kBlocksFull) != 0;
  if ((did.status & (CarveStep::kBlocksFull | CarveStep::kNotFinite | CarveStep::kTooLong)) != 0)
    return false;
  for (std::size_t n = 0; n < field.block_count(); ++n)
    if (field.changed_at(n) > before) changed_.push_back({bone, field.block_at(n)});
  return true;
}

// Once: it stays so until the bone is put back.
void Carving::tell_full(std::size_t hand, const Push& push, bool was_full) {
  if (full_ && !was_full) tell(hand, push, kCarvingFull, {});
}

void Carving::note_tissue(std::size_t hand, const Push& push, std::optional<BoneTissue> tissue) {
  CarvingHand& h = hands_[hand];
  const auto now = static_cast<std::uint8_t>(tissue ? 1 + static_cast<int>(*tissue) : 0);
  if (now == h.tissue) return;
  h.tissue = now;
  const double thrust = setup_->thrust_scale * push.force_B.norm();
  const double depth_mm = 1000 * h.drill.depth_m;
  if (tissue == BoneTissue::kCartilage) tell(hand, push, kCartilageEntered, {depth_mm, thrust, 0});
  if (tissue == BoneTissue::kCortical) tell(hand, push, kCortexEntered, {depth_mm, thrust, 0});
  if (tissue == BoneTissue::kCancellous)
    tell(hand, push, kCancellousEntered, {depth_mm, thrust, 0});
}

// Of a drill alone: whether its tip has come out of the bone, and how far it went on.
void Carving::follow_out(std::size_t hand, const Push& push) {
  CarvingHand& h = hands_[hand];
  const Vec3 way = -back_of(h.X_BC);
  if (h.out > 0) {
    h.plunge_m = std::max(h.plunge_m, way.dot(push.X_BT.p - h.p_out));
    if (++h.out <= kPlungeSteps) return;
    tell(hand, push, kPlunge, {1000 * h.plunge_m, 0, 0});
    h.out = 0;
    h.was_in = false;
    return;
  }
  if (!h.was_in || h.drill.depth_m < kDeepEnough_m) return;
  const CarvedField& field = *bones_[h.bone].field;
  if (!was_outside(field, push.X_BT.p) || way.dot(push.X_BT.p - h.X_BC.p) < -kBehind_m) return;
  h.out = 1;
  h.p_out = h.X_BC.p;
  tell(hand, push, kBreached,
       {1000 * h.drill.depth_m, setup_->thrust_scale * push.force_B.norm(), 0});
}

void Carving::rest(std::size_t hand, const Push& push) {
  CarvingHand& h = hands_[hand];
  if (h.bone == CarvingHand::kNoBone) return;
  h.drill.was_cutting = false;
  const auto& with = setup_->tray[push.tool->instrument];
  if (with && goes_forward(with->way)) follow_out(hand, push);
  if (++h.idle < kRestSteps) return;
  run_smoothly(hand, push);
  if (h.out > 0) return;
  const double seconds = kStep_s * static_cast<double>(steps_ - h.since);
  if (h.most_torque_nm > 0 || (h.was_in && !h.in_hole))
    tell(hand, push, kCutEnd, {1000 * h.drill.depth_m, seconds, 1000 * h.most_torque_nm});
  h.most_torque_nm = 0;
  h.since = steps_;
  if (h.in_hole) return;
  h = anew(h);
}

// What no hole holds yet may be elsewhere on the bone by now.
bool Carving::slid_off(const CarvingHand& h, const Push& push) const {
  const auto& with = setup_->tray[push.tool->instrument];
  if (h.in_hole || with->way != Way::kDrill) return false;
  const Vec3 off = push.X_BT.p - h.X_BC.p, back = back_of(h.X_BC);
  return (off - off.dot(back) * back).norm() > kSlid_m;
}

// Of what goes forward along its axis. False: it is pulled back, and not at its hole's end.
bool Carving::stand_before(std::size_t hand, const CarvingTool& with, const Push& push) {
  CarvingHand& h = hands_[hand];
  const double ahead = back_of(h.X_BC).dot(h.X_BC.p - push.X_BT.p);
  const bool same = h.bone == push.bone;
  if (same && !(ahead > kBeyond_m) && !slid_off(h, push)) return ahead >= -kBehind_m;
  const CarvingHand before = h;
  begin(hand, with, push);
  const bool was_full = full_;
  if (with.way != Way::kDrill && !remove(hand, with.cutter, h.X_BC, h.X_BC))
    tell_full(hand, push, was_full);
  if (!same || !(ahead > kBeyond_m)) return true;
  h.was_in = before.was_in;
  h.out = before.out;
  h.p_out = before.p_out;
  h.plunge_m = before.plunge_m;
  h.since = before.since;
  h.drill.depth_m += before.drill.depth_m;
  return true;
}

// Turns a second: of the motor, or of the hand.
double Carving::turning(std::size_t hand, const CarvingTool& with, const Push& push,
                        double step_s) {
  if (with.way == Way::kDrill) return push.tool->power * with.most_rev_per_s;
  CarvingHand& h = hands_[hand];
  const double now = twist_about(h.X_BC, push.X_BT);
  const double turned = std::remainder(now - h.twist_rad, 2 * std::numbers::pi);
  h.twist_rad = now;
  return std::min(std::abs(turned) / (2 * std::numbers::pi * step_s), kFastestByHand_rev_per_s);
}

void Carving::go_on(std::size_t hand, const CarvingTool& with, const Push& push, double advance_m) {
  CarvingHand& h = hands_[hand];
  h.due_m += advance_m;
  if (h.due_m < CarvingSetup::kBite_m) return;
  const Pose from = cutter_pose(h);
  const Pose next = moved_along(from, -h.due_m * back_of(h.X_BC));
  // Where the cutter stood it has cut: within half a cell only the new place is left.
  const bool near = h.due_m <= 0.5 * bones_[h.bone].field->grid().cell_m;
  const bool was_full = full_;
  if (remove(hand, with.cutter, near ? next : from, next)) {
    const double caught_up = std::min(h.lag_m, h.due_m);
    h.lag_m -= caught_up;
    if (h.lag_m == 0)
      h.X_BC = caught_up > 0 ? moved_along(h.X_BC, (caught_up - h.due_m) * back_of(h.X_BC)) : next;
  } else {
    tell_full(hand, push, was_full);
  }
  h.due_m = 0;
}

// Told when it begins and when it has become another one.
void Carving::shake(std::size_t hand, const CarvingTool& with, const Push& push, double rev_per_s) {
  constexpr double kOther = 0.5, kLeast_m = 5e-6;
  CarvingHand& h = hands_[hand];
  const double depth = cut_a_side(*bones_[h.bone].field, with.cutter, cutter_pose(h));
  const double canal = with.cutter.size_m - 2 * depth;
  const auto now = reamer_chatter(setup_->table, with.cutter.size_m, canal, rev_per_s, depth > 0);
  if (!now || now->amplitude_m < kLeast_m) return run_smoothly(hand, push);
  const auto alike = [](double a, double b) { return std::abs(a - b) <= kOther * b; };
  if (alike(now->amplitude_m, h.chatter.amplitude_m) &&
      alike(now->frequency_hz, h.chatter.frequency_hz))
    return;
  if (!(h.chatter.amplitude_m > 0)) h.chatters_since = steps_;
  h.chatter = *now;
  tell(hand, push, kChatter, {1000 * now->amplitude_m, now->frequency_hz, 0});
}

void Carving::run_smoothly(std::size_t hand, const Push& push) {
  CarvingHand& h = hands_[hand];
  if (!(h.chatter.amplitude_m > 0)) return;
  h.chatter = {};
  const double seconds = kStep_s * static_cast<double>(steps_ - h.chatters_since);
  tell_of(hand, *push.tool, kChatterEnd, h.bone, {seconds, 0, 0});
}

// A push beyond the line's resistance F(D) lets the drill go on until the hand's spring holds no
// more than F: by a part of the spring's length at each step, since the hand learns of it two steps
// later. Bone tells the torque alone.
DrillStep Carving::go_guided(std::size_t hand, const CarvingTool& with,
                             const DrillMaterial& material, double push_n, double rev_per_s,
                             double step_s) {
  constexpr double kGives_m_per_n = 1e-4, kFastest_m_per_s = 0.05;
  CarvingHand& h = hands_[hand];
  const CarvedField& field = *bones_[h.bone].field;
  const Vec3 back = back_of(h.X_BC);
  GuidedTunnel tunnel;
  tunnel.length_m = std::max(way_in_bone(field, h.mouth_B, -back), field.grid().cell_m);
  tunnel.force_n = setup_->guided_n;
  RbfDrillState drilled;
  DrillStep out;
  out.resistance_n = rbf_drill_force(drilled, tunnel, back.dot(h.mouth_B - h.X_BC.p));
  const double over = std::max(0.0, push_n - out.resistance_n);
  out.advance_m = std::min(kGives_m_per_n * over, kFastest_m_per_s * step_s);
  out.feed_m_per_rev = out.advance_m / (rev_per_s * step_s);
  const double area = 0.25 * std::numbers::pi * with.cutter.size_m * with.cutter.size_m;
  out.cutting_w = material.specific_energy_j_per_m3 * area * out.advance_m / step_s;
  out.torque_nm = out.cutting_w / (2 * std::numbers::pi * rev_per_s);
  h.drill.depth_m += out.advance_m;
  h.drill.turned_rev += rev_per_s * step_s;
  h.drill.was_cutting = out.advance_m > 0;
  return out;
}

void Carving::drill(std::size_t hand, const CarvingTool& with, const Push& push, double step_s) {
  CarvingHand& h = hands_[hand];
  if (!stand_before(hand, with, push)) return rest(hand, push);
  const Vec3 back = back_of(h.X_BC);
  const CarvedField& field = *bones_[h.bone].field;
  const bool by_hand = with.way == Way::kTwist;
  const DrillTable& table = by_hand ? setup_->by_hand : setup_->table;
  follow_out(hand, push);
  const FrontShare front = by_hand ? look_before_point(field, with.cutter, h.X_BC)
                                   : look_before(field, with.cutter, with.pilot_m, cutter_pose(h));
  note_tissue(hand, push, front.most());
  const DrillMaterial material = mixed(table, front);
  // What leads it, or its own hole, holds a drill; a cannula that is empty does not.
  const bool held = h.rod != 0 || h.in_hole || by_hand;
  const double angle = held ? 0.0 : h.angle_rad;
  const bool has_start = h.drill.depth_m >= table.start_depth_m;
  const bool slides = !held && !has_start && angle > table.skive_angle_rad;
  const DrillTool tool{with.cutter.size_m, turning(hand, with, push, step_s), 0,
                       slides ? 0 : with.pilot_m};
  const double thrust = setup_->thrust_scale * std::max(0.0, push.force_B.dot(back));
  const bool first = h.most_torque_nm == 0;
  const bool guided = setup_->guided_n > 0 && h.rod != 0;
  const DrillStep did =
      guided ? go_guided(hand, with, material, thrust / setup_->thrust_scale, tool.speed_rev_per_s,
                         step_s)
             : step_drill(h.drill, table, tool, {&material, by_hand ? h.angle_rad : angle}, thrust,
                          step_s);
  if (did.skives && !h.skives)
    tell(hand, push, kSkives, {h.angle_rad * 180 / std::numbers::pi, thrust, 0});
  h.skives = did.skives;
  readouts_[hand] = {h.bone,        h.X_BC.p, back,          0.5 * with.cutter.size_m,
                     did.advance_m, thrust,   did.torque_nm, did.cutting_w,
                     did.rubbing_w};
  if (!(did.advance_m > 0)) {
    // Thrown back, its teeth come again; a reamer that is pressed too lightly cuts no more.
    if (with.reams && ++h.idle >= kRestSteps) run_smoothly(hand, push);
    return;
  }
  if (with.reams) shake(hand, with, push, tool.speed_rev_per_s);
  h.idle = 0;
  const bool outside = was_outside(field, h.X_BC.p);
  h.open = h.was_in && outside && front.left() == 0;
  h.was_in = h.was_in || !outside;
  h.in_hole = true;
  if (first) tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, thrust, 0});
  h.most_torque_nm = std::max(h.most_torque_nm, did.torque_nm);
  go_on(hand, with, push, did.advance_m);
}

// To go on by dx takes u A dx, u the specific energy of what stands before the edge, A the blade's
// cross-section: the blows give it by their power, a push that is larger than u A by itself.
void Carving::strike(std::size_t hand, const CarvingTool& with, const Push& push, double step_s) {
  CarvingHand& h = hands_[hand];
  if (!stand_before(hand, with, push)) return rest(hand, push);
  const Vec3 back = back_of(h.X_BC);
  const CarvedField& field = *bones_[h.bone].field;
  follow_out(hand, push);
  const FrontShare front = look_before_edge(field, with.cutter.size_m, h.X_BC);
  note_tissue(hand, push, front.most());
  const DrillMaterial material = mixed(setup_->table, front);
  const double area = with.cutter.size_m * with.cutter.parts.front().box.extent().y();
  const double needed = material.specific_energy_j_per_m3 * area;
  const double thrust = setup_->thrust_scale * std::max(0.0, push.force_B.dot(back));
  const double blows_w = thrust > 0 ? push.tool->power * with.most_w : 0;
  const double more = std::max(0.0, thrust / needed - 1);
  const double speed =
      std::min(blows_w / needed + more * kBladeFastest_m_per_s, kBladeFastest_m_per_s);
  const bool first = h.most_torque_nm == 0;
  readouts_[hand] = {h.bone, h.X_BC.p, back, 0.5 * with.cutter.size_m, speed * step_s, thrust,
                     0,      0,        0};
  if (!(speed > 0)) return;
  h.idle = 0;
  const bool outside = was_outside(field, h.X_BC.p);
  h.open = h.was_in && outside && front.left() == 0;
  h.was_in = h.was_in || !outside;
  h.in_hole = true;  // an edge is thinner than the field's cells: its slot is felt as a line
  if (first) tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, thrust, 0});
  h.most_torque_nm = std::max(h.most_torque_nm, 1e-9);  // it has cut; a blade is not turned
  h.drill.depth_m += speed * step_s;
  go_on(hand, with, push, speed * step_s);
}

// Of what scrapes, its speed is that of the hand along the bone.
void Carving::burr(std::size_t hand, const CarvingTool& with, const Push& push, double step_s) {
  CarvingHand& h = hands_[hand];
  const double press = push.force_B.norm(), radius = 0.5 * with.cutter.size_m;
  const Vec3 nhat = push.force_B / press;
  if (with.one_sided && (push.X_BT.q * Vec3::UnitY()).dot(nhat) > -kLeastFacing)
    return rest(hand, push);
  if (h.bone != push.bone) begin(hand, with, push);
  const CarvedField& field = *bones_[h.bone].field;
  const FrontShare front = look_under_ball(field, radius, push.X_BT * with.middle_T, nhat);
  // The points over its half lie beside the pole, which touches: a shaver asks there too.
  const double ahead = radius + 0.6 * field.grid().cell_m;
  const auto pole =
      with.soft_only ? tissue_at(field, push.X_BT * with.middle_T - ahead * nhat) : std::nullopt;
  const bool hard = pole == BoneTissue::kCortical || pole == BoneTissue::kCancellous;
  if (with.soft_only && ((front.left() == 0 && !pole) || front.meets_bone() || hard))
    return rest(hand, push);
  note_tissue(hand, push, front.left() == 0 ? pole : front.most());
  const DrillMaterial material = mixed(setup_->table, front);
  const bool scrapes = with.way == Way::kScrape;
  const Vec3 drawn = push.X_WB.q.conjugate() * push.tool->v_W;
  const double m_per_s =
      scrapes ? (drawn - nhat * nhat.dot(drawn)).norm()
              : std::numbers::pi * with.cutter.size_m * push.tool->power * with.most_rev_per_s;
  const double force = with.grip * (scrapes ? setup_->thrust_scale * press : press);
  const double area = 0.5 * std::numbers::pi * radius * radius;
  // Over the whole half ball the energy is that of its shares; the rest of it cuts air.
  const double rate = force * m_per_s / material.specific_energy_j_per_m3 / area;
  const double advance = std::min(rate, kBurrFastest_m_per_s) * step_s;
  const bool first = h.most_torque_nm == 0;
  const double torque = force * radius;
  readouts_[hand] = {
      h.bone,  push.X_BT.p, nhat,   radius,
      advance, press,       torque, advance * area * material.specific_energy_j_per_m3 / step_s,
      0};
  if (!(advance > 0)) return;
  h.idle = 0;
  h.was_in = true;
  h.most_torque_nm = std::max(h.most_torque_nm, torque);
  if (first) tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, press, 0});
  // So far the cut lies ahead of the ball: a shallow one is smoothed away until it is deep enough
  // for the ball to follow.
  const Vec3 moved = first ? Vec3(Vec3::Zero()) : Vec3(push.X_BT.p - h.p_out);
  h.p_out = push.X_BT.p;
  h.due_m = std::clamp(h.due_m + advance - moved.norm(), 0.0, kBurrLead_m);
  h.plunge_m += advance;
  if (h.plunge_m < CarvingSetup::kBite_m) return;
  const Pose from = moved_along(push.X_BT, (CarvingSetup::kSlack_m - kSkin_m) * nhat);
  h.X_BC = moved_along(from, -std::max(h.due_m, h.plunge_m) * nhat);
  h.drill.depth_m += h.plunge_m;
  const bool was_full = full_;
  if (!remove(hand, with.cutter, from, h.X_BC)) tell_full(hand, push, was_full);
  h.plunge_m = 0;
}

void Carving::bite(std::size_t hand, const CarvingTool& with, const ToolState& tool,
                   const Pose& X_BT, std::uint32_t bone) {
  CarvingHand& h = hands_[hand];
  if (!h.jaw_open || tool.jaw > 0.1) return;
  const std::uint32_t bone_before = h.bone;
  h.bone = bone;
  const std::size_t before = changed_.size();
  Push push;
  push.tool = &tool;
  push.bone = bone;
  const bool was_full = full_;
  if (!remove(hand, with.cutter, X_BT, X_BT)) tell_full(hand, push, was_full);
  if (changed_.size() > before)
    tell(hand, push, kCutBegin, {1000 * with.cutter.size_m, 0, 0});
  else
    h.bone = bone_before;
}

std::uint64_t Carving::hash() {
  Hasher hasher;
  for (Bone& bone : bones_)
    if (bone.field) hasher.add(bone.field->hash());
  for (const CarvingHand& hand : hands_) add_to(hasher, hand);
  hasher.add(steps_);
  hasher.add(full_);
  for (const GuideRod& rod : rods_)
    if (rod.kind != GuideRod::Kind::kNone) add_to(hasher, rod);
  for (const LeftHole& hole : holes_)
    if (hole.bone != CarvingHand::kNoBone) add_to(hasher, hole);
  return hasher.value();
}

CarvingState Carving::save() const {
  CarvingState state;
  for (const Bone& bone : bones_)
    state.bones.push_back(bone.field ? bone.field->save() : CarveState{});
  state.hands = hands_;
  state.steps = steps_;
  state.full = full_;
  state.rods = rods_;
  state.holes = holes_;
  return state;
}

bool Carving::fits(const CarvingState& state) const {
  if (state.bones.size() != bones_.size()) return false;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    if (!bones_[b].field) continue;
    CarvedField copy = *bones_[b].field;
    if (!copy.restore(state.bones[b])) return false;
  }
  const auto is_carved = [&](std::uint32_t b) { return b < bones_.size() && bones_[b].field; };
  for (const CarvingHand& hand : state.hands)
    if (hand.bone != CarvingHand::kNoBone && !is_carved(hand.bone)) return false;
  for (const GuideRod& rod : state.rods)
    if (rod.kind != GuideRod::Kind::kNone && !is_carved(rod.bone)) return false;
  for (const LeftHole& hole : state.holes)
    if (hole.bone != CarvingHand::kNoBone && !is_carved(hole.bone)) return false;
  return true;
}

void Carving::restore(const CarvingState& state) {
  for (std::size_t b = 0; b < bones_.size(); ++b)
    if (bones_[b].field) (void)bones_[b].field->restore(state.bones[b]);
  hands_ = state.hands;
  steps_ = state.steps;
  full_ = state.full;
  rods_ = state.rods;
  holes_ = state.holes;
  guides_ = {};
  changed_.clear();
  fallen_.clear();
  events_.clear();
}

}  // namespace osteon
