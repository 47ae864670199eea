// What goes forward along its axis: drill, pin, reamer, awl, blade.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "carving_push.h"
#include "cutter_front.h"
#include "osteon/carve/rbf_force.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

using namespace carving;

namespace {

constexpr double kBehind_m = 0.0003;  // pulled back so far, the drill is not at the hole's end
constexpr double kSlid_m = 0.0005;    // slid off so far sideways, it begins anew
constexpr double kBeyond_m = 0.001;   // gone on so far through nothing, it begins anew
constexpr std::uint32_t kPlungeSteps = 250;
constexpr double kDeepEnough_m = 0.001;  // a shallower hole has no far side
constexpr double kBladeFastest_m_per_s = 0.02;
constexpr double kFastestByHand_rev_per_s = 4;  // also after a while in the air

using Way = CarvingTool::Way;

// How far a tool is turned about its own axis from how the cutter stood, -pi to pi.
double twist_about(const Pose& X_BC, const Pose& X_BT) {
  const Quat q = X_BC.q.conjugate() * X_BT.q;
  return 2 * std::atan2(q.w() < 0 ? -q.z() : q.z(), std::abs(q.w()));
}

// How far behind a pose a cutter's whole front is free of bone.
double lag_of(const CarvedField& field, const CarvingTool& with, const Pose& X_BC) {
  constexpr double kStep_m = 1e-4, kMostSizes = 2;
  constexpr int kHalvings = 4;
  const Vec3 back = back_of(X_BC);
  const auto is_free = [&](double lag) {
    return front_is_free(field, with.cutter, with.pilot_m, moved_along(X_BC, lag * back));
  };
  double lag = 0;
  while (lag < kMostSizes * with.cutter.size_m && !is_free(lag + kStep_m)) lag += kStep_m;
  double free = lag + kStep_m;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (lag + free);
    (is_free(middle) ? free : lag) = middle;
  }
  return lag;
}

}  // namespace

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
  // Held by the bone that it has gone through, it is in the same hole.
  const Vec3 to_mouth = before.mouth_B - h.X_BC.p;
  const Vec3 along = to_mouth.dot(back_of(h.X_BC)) * back_of(h.X_BC);
  if (before.in_hole && (to_mouth - along).norm() < kSlid_m) {
    h.mouth_B = before.mouth_B;
    h.in_hole = true;
  }
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
                     did.rubbing_w, false};
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
  readouts_[hand] = {h.bone, h.X_BC.p, back, 0.5 * with.cutter.size_m, speed * step_s, thrust, 0,
                     0,      0,        false};
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

}  // namespace osteon
