#include "osteon/physics/graft_placing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "jaws.h"
#include "osteon/scene/graft.h"

namespace osteon {
namespace {

using PlacingKind = PlacingTool::Kind;

constexpr double kPinTakeOn_m = 0.005;  // so near its line a pin is led
constexpr double kPinTurn = 0.82;       // least cosine between the axes then
constexpr double kPinAhead_m = 0.010;
constexpr double kClampOff_m = 0.015;    // beyond the tibia a clamp is free again
constexpr double kPinOff_m = 0.003;      // drawn back so far before the mouth it is off again
constexpr double kLeadStep = 0.02;       // a line holds within 50 steps
constexpr double kJawReach_m = 0.010;    // jaws take a thread
constexpr double kOutOfSkin_m = 0.020;   // from the cortex to where the thread is taken hold of
constexpr double kAside_m = 0.002;       // a clamp may lean so far beyond the tunnel's wall
constexpr double kEndInJoint_m = 0.010;  // over the tibia's mouth the thread's end comes to lie
// So near the outer mouth a screw may begin: it touches first where the mouth's rim stands out
// farthest, 11 mm before its middle for a screw of 10 mm and a tunnel 65 degrees oblique.
constexpr double kScrewStarts_m = 0.012;
constexpr double kScrewAside_m = 0.003;
constexpr double kScrewTurn = 0.77;    // 40 degrees
constexpr double kScrewOff_m = 0.012;  // drawn back so far from where it began it is let go
constexpr double kJoint_m = 0.040;     // a thread's end farther from the mouth is lost

struct TunnelNow {
  Vec3 mouth_W, outer_W, out_W;
};
TunnelNow tunnel_now(const PlacingTunnel& tunnel, const BoneSnapshot& bones) {
  const Pose& X_WB = bones.bones[tunnel.bone].X_WB;
  TunnelNow now{X_WB * tunnel.mouth_B, X_WB * tunnel.outer_B, Vec3::Zero()};
  now.out_W = (now.outer_W - now.mouth_W).normalized();
  return now;
}

Result<void> check_tunnel(const PlacingTunnel& tunnel, const char* name) {
  const bool good = is_finite(tunnel.mouth_B) && is_finite(tunnel.outer_B) &&
                    std::isfinite(tunnel.radius_m) && tunnel.radius_m > 0 &&
                    tunnel.bone < kMaxBones && (tunnel.outer_B - tunnel.mouth_B).norm() > 1e-3;
  if (good) return {};
  return fail("is not a tunnel of a millimetre or longer in a bone", name, "Drill it");
}

// Does the instrument lie in the tunnel: does its shaft's line pass through the outer mouth?
bool lies_in(const ToolState& tool, const PlacingTunnel& tunnel, const TunnelNow& now) {
  const Vec3 axis = tool.X_WP.q * Vec3::UnitZ(), off = now.outer_W - tool.X_WP.p;
  const double s = axis.dot(off);
  return s > 0 && (off - s * axis).norm() < tunnel.radius_m + kAside_m;
}

PassingWay passing_way(const PlacingPlan& p) {
  return {p.tibia.length_m(),   p.between_m,          p.femur.length_m(), p.socket_m,
          2 * p.tibia.radius_m, 2 * p.femur.radius_m, p.tibia_bend_rad,   p.femur_bend_rad};
}

// What is left once a screw is out: how the graft was worked.
PlacingScrew without_screw(const PlacingScrew& screw) {
  PlacingScrew none;
  none.cycles = screw.cycles;
  return none;
}

// It stays where it is, or comes out again.
void let_go_screw(PlacingHand& h, const BoneSnapshot& bones, GraftPlacingState& state) {
  PlacingScrew& screw = state.screw;
  h.line = PlacingLine::kNone;
  if (screw.in_m < GraftPlacing::kScrewHolds_m) {
    screw = without_screw(screw);
    return;
  }
  screw.done = true;
  screw.tension_n = state.tension_n;
  screw.flexion_deg = bones.bend.now_deg;
}

// A bend counts that was made while the tail was pulled.
void count_cycles(const BendState& bend, GraftPlacingState& state) {
  if (state.phase != PlacingPhase::kTurned || state.screw.done) return;
  const bool more = bend.cycles > state.cycles_before;
  if (more && state.tension_n >= GraftPlacing::kWorks_n) ++state.screw.cycles;
  state.cycles_before = bend.cycles;
}

ToolGuide line_along(const PlacingTunnel& tunnel, const PlacingHand& hand, bool joint_end,
                     double towards) {
  ToolGuide out;
  out.on = true;
  out.instrument = hand.instrument;
  out.bone = tunnel.bone;
  out.p_B = joint_end ? tunnel.mouth_B : tunnel.outer_B;
  out.nhat_B = towards * (tunnel.outer_B - tunnel.mouth_B).normalized();
  out.grip = hand.grip;
  return out;
}

}  // namespace

Result<GraftPlacing> GraftPlacing::make(PlacingPlan plan, std::vector<PlacingTool> tray,
                                        double step_s) {
  if (auto ok = check_tunnel(plan.femur, "placing the graft: femur"); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = check_tunnel(plan.tibia, "placing the graft: tibia"); !ok)
    return tl::unexpected(ok.error());
  if (!(step_s > 0 && step_s < 1))
    return fail("a step is not within 0 to 1 s", "placing the graft");
  GraftPlacing made(std::move(plan), std::move(tray), step_s);
  auto passed = pass_graft(made.way_, made.graft_);
  if (!passed) return tl::unexpected(passed.error());
  made.passed_ = std::move(*passed);
  return made;
}

GraftPlacing::GraftPlacing(PlacingPlan plan, std::vector<PlacingTool> tray, double step_s)
    : plan_(std::move(plan)),
      way_(passing_way(plan_)),
      graft_{plan_.graft_m, plan_.graft_length_m, plan_.loop_m, plan_.tail_n},
      tray_(std::move(tray)),
      step_s_(step_s) {}

GraftPlacingState GraftPlacing::begin() const {
  GraftPlacingState state;
  state.on = true;
  state.plan = plan_;
  return state;
}

void GraftPlacing::pull(double tension_n, GraftPlacingState& state) {
  if (!state.on || state.phase != PlacingPhase::kTurned || state.screw.done) return;
  if (!(tension_n >= 0 && tension_n <= kMostTension_n)) return;
  state.tension_n = tension_n;
}

GraftPlacingState GraftPlacing::gone_back(const GraftPlacingState& kept) {
  GraftPlacingState state = kept;
  state.hands = {};
  // A hand that comes back holds nothing: an end that it held hangs where the jaws were.
  if (state.phase == PlacingPhase::kThreadHeld) state.phase = PlacingPhase::kThreadInside;
  state.holder = 0;
  state.pull_n = 0;
  state.told = 0;
  // A screw that was being turned in holds or has come out.
  const bool half_way = state.screw.screws > 0 && !state.screw.done;
  if (half_way) state.screw = without_screw(state.screw);
  return state;
}

PlacingKind GraftPlacing::held(const ToolState& tool) const {
  return tool.instrument < tray_.size() ? tray_[tool.instrument].kind : PlacingKind::kOther;
}

double GraftPlacing::end_m(PlacingLine line) const {
  if (line == PlacingLine::kPin) return way_.channel_m + kThrough_m + kThread_m;
  return passed_.turns ? passed_.end_m + kOverdraw_m : passed_.end_m;
}

double GraftPlacing::resistance_n(PlacingLine line, double front_m) const {
  if (line == PlacingLine::kPin) return kPin_n;
  double r = passing_pull_n(way_, graft_, front_m) / kLever;
  const double before = passed_.end_m - front_m;
  if (passed_.turns && before > 0 && before < kSill_m) r += kSill_n * (1 - before / kSill_m);
  return r;
}

double GraftPlacing::go_on(PlacingLine line, double front_m, double force_n) const {
  const double over = force_n - resistance_n(line, front_m);
  if (!(over > 0)) return front_m;
  const double way = step_s_ * std::min(over / kSlow_n_s_per_m, kFastest_m_per_s);
  return std::min(front_m + way, end_m(line));
}

// The pin takes its thread along: through, the end stays in the joint; drawn on, it is lost.
void GraftPlacing::lead_pin(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                            GraftPlacingState& state) const {
  PlacingHand& h = state.hands[hand];
  const TunnelNow femur = tunnel_now(plan_.femur, bones);
  const Vec3 off = tool.X_WP.p - femur.mouth_W;
  const double s = femur.out_W.dot(off);
  if (h.line == PlacingLine::kNone) {
    const bool free = state.phase == PlacingPhase::kEmpty && state.pin_m == 0;
    const bool along = -(tool.X_WP.q * Vec3::UnitZ()).dot(femur.out_W) > kPinTurn;
    const bool near =
        s > -kPinOff_m && s < kPinAhead_m && (off - s * femur.out_W).norm() < kPinTakeOn_m;
    if (free && along && near) h = {h.instrument, PlacingLine::kPin, 0, h.shut, 0};
    return;
  }
  h.grip = std::min(1.0, h.grip + kLeadStep);
  const double wanted = femur.out_W.dot(tool.X_WD.p - femur.mouth_W);
  const double through = way_.channel_m + kThrough_m;
  if (std::min(s, wanted) < -kPinOff_m) {
    // Drawn back it takes the thread back with it, unless that lies in the femur already.
    h.line = PlacingLine::kNone;
    if (state.phase == PlacingPhase::kEmpty) state.pin_m = 0;
    return;
  }
  if (s < state.pin_m - 0.002) return;
  state.pin_m =
      go_on(PlacingLine::kPin, state.pin_m, std::min(-femur.out_W.dot(tool.force_W), kMostHand_n));
  if (state.pin_m >= through && state.phase == PlacingPhase::kEmpty) {
    state.phase = PlacingPhase::kThreadInside;
    const Vec3 below = tunnel_now(plan_.tibia, bones).mouth_W;
    state.end_W = below + kEndInJoint_m * (femur.mouth_W - below).normalized();
  }
  if (state.phase == PlacingPhase::kThreadInside && state.pin_m >= end_m(PlacingLine::kPin)) {
    state.phase = PlacingPhase::kEmpty;
    state.pin_m = 0;
    h.line = PlacingLine::kNone;
    ++state.lost;
  }
}

void GraftPlacing::shut_on(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                           GraftPlacingState& state) const {
  const Vec3& p_W = tool.X_WP.p;
  if (state.phase == PlacingPhase::kThreadInside && (p_W - state.end_W).norm() < kJawReach_m &&
      lies_in(tool, plan_.tibia, tunnel_now(plan_.tibia, bones))) {
    state.phase = PlacingPhase::kThreadHeld;
    state.holder = 1 + hand;
    return;
  }
  if (state.phase != PlacingPhase::kThreadOut) return;
  const TunnelNow femur = tunnel_now(plan_.femur, bones);
  const Vec3 off = p_W - femur.outer_W;
  const double s = femur.out_W.dot(off);
  const bool near = s > kOutOfSkin_m && (off - s * femur.out_W).norm() < kJawReach_m;
  if (!near) return;
  PlacingHand& h = state.hands[hand];
  h.line = PlacingLine::kDraw;
  h.grip = 0;
  h.from_m = s - state.drawn_m;
}

// An end let go beyond the tibia is out; in the joint it lies where it was; elsewhere it is lost.
// The thread let go beyond the femur: a button that is out turns.
void GraftPlacing::open(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                        GraftPlacingState& state) const {
  PlacingHand& h = state.hands[hand];
  if (state.phase == PlacingPhase::kThreadHeld && state.holder == 1 + hand) {
    const TunnelNow tibia = tunnel_now(plan_.tibia, bones);
    const TunnelNow femur = tunnel_now(plan_.femur, bones);
    state.holder = 0;
    if (tibia.out_W.dot(tool.X_WP.p - tibia.outer_W) > 0) {
      state.phase = PlacingPhase::kThreadOut;
    } else if ((tool.X_WP.p - femur.mouth_W).norm() < kJoint_m) {
      state.phase = PlacingPhase::kThreadInside;
      state.end_W = tool.X_WP.p;
    } else {
      state.phase = PlacingPhase::kEmpty;
      state.pin_m = 0;
      ++state.lost;
    }
    return;
  }
  if (h.line != PlacingLine::kDraw) return;
  h.line = PlacingLine::kNone;
  state.pull_n = 0;
  const double in_channel = passed_.end_m - 2 * kFlipRoom_m;
  if (passed_.turns && state.drawn_m >= passed_.end_m) {
    state.phase = PlacingPhase::kTurned;
    state.gap_m = std::max(0.0, state.drawn_m - passed_.end_m - kFree_m);
  } else if (state.drawn_m > in_channel) {
    ++state.let_go_early;
  }
}

// Jaws that come in line with the outer mouth go in; beyond it they are free again.
void GraftPlacing::follow_tibia(std::uint32_t hand, const ToolState& tool,
                                const BoneSnapshot& bones, GraftPlacingState& state) const {
  PlacingHand& h = state.hands[hand];
  const TunnelNow tibia = tunnel_now(plan_.tibia, bones);
  const double length = plan_.tibia.length_m();
  const Vec3 off = tool.X_WP.p - tibia.mouth_W;
  const double s = tibia.out_W.dot(off);
  if (h.line == PlacingLine::kTibia) {
    h.grip = std::min(1.0, h.grip + kLeadStep);
    if (std::max(s, tibia.out_W.dot(tool.X_WD.p - tibia.mouth_W)) > length + kClampOff_m)
      h.line = PlacingLine::kNone;
    return;
  }
  const bool along = (tool.X_WP.q * Vec3::UnitZ()).dot(tibia.out_W) > kPinTurn;
  const bool near = s > length - kPinOff_m && s < length + kPinAhead_m &&
                    (off - s * tibia.out_W).norm() < kPinTakeOn_m;
  if (h.line != PlacingLine::kNone || !along || !near) return;
  h.line = PlacingLine::kTibia;
  h.grip = 0;
}

// A screw's line is where it stood and looked as it began to turn.
void GraftPlacing::turn_screw(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                              GraftPlacingState& state) const {
  PlacingHand& h = state.hands[hand];
  PlacingScrew& screw = state.screw;
  const Pose X_BT = bones.bones[plan_.tibia.bone].X_WB.inverse() * tool.X_WP;
  const Vec3 out_B = (plan_.tibia.outer_B - plan_.tibia.mouth_B).normalized();
  if (h.line == PlacingLine::kNone) {
    const Vec3 off = X_BT.p - plan_.tibia.outer_B, axis_B = X_BT.rotate(Vec3::UnitZ());
    const double s = out_B.dot(off);
    const bool there = std::abs(s) < kScrewStarts_m &&
                       (off - s * out_B).norm() < plan_.tibia.radius_m + kScrewAside_m &&
                       axis_B.dot(out_B) > kScrewTurn;
    const bool may = state.phase == PlacingPhase::kTurned && !screw.done && screw.in_m == 0;
    if (!there || !may || !(tool.power > 0)) return;
    screw.screws = state.screw.screws + 1;
    screw.p_B = X_BT.p;
    screw.out_B = axis_B;
    screw.width_m = tray_[tool.instrument].width_m;
    screw.length_m = kScrewLength_m;
    h.line = PlacingLine::kScrew;
    h.grip = 0;
    return;
  }
  h.grip = std::min(1.0, h.grip + kLeadStep);
  const Pose& X_WB = bones.bones[plan_.tibia.bone].X_WB;
  const Vec3 line_W = X_WB.rotate(screw.out_B);
  const double at_m = line_W.dot(tool.X_WP.p - X_WB * screw.p_B);
  if (at_m > kScrewOff_m) return let_go_screw(h, bones, state);
  const bool turned =
      tool.power > 0 && line_W.dot(tool.force_W) > kScrew_n && at_m < -screw.in_m + 0.002;
  if (!turned) return;
  const double end = std::min(screw.length_m + kScrewBeyond_m, plan_.tibia.length_m());
  screw.in_m = std::min(end, screw.in_m + step_s_ * kScrewTurn_m_per_s * std::min(1.0, tool.power));
}

void GraftPlacing::use_clamp(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                             GraftPlacingState& state) const {
  PlacingHand& h = state.hands[hand];
  const bool shut = tool.jaw < kJawsShut;
  if (shut && !h.shut) shut_on(hand, tool, bones, state);
  if (!shut && h.shut) open(hand, tool, bones, state);
  h.shut = shut;
  if (state.phase == PlacingPhase::kThreadHeld && state.holder == 1 + hand)
    state.end_W = tool.X_WP.p;
  if (h.line != PlacingLine::kDraw) follow_tibia(hand, tool, bones, state);
  if (h.line != PlacingLine::kDraw) return;
  h.grip = std::min(1.0, h.grip + kLeadStep);
  const TunnelNow femur = tunnel_now(plan_.femur, bones);
  const double hand_n = std::clamp(-femur.out_W.dot(tool.force_W), 0.0, kMostHand_n);
  state.drawn_m = go_on(PlacingLine::kDraw, state.drawn_m, hand_n);
  state.pull_n = kLever * hand_n;
  state.most_pull_n = std::max(state.most_pull_n, state.pull_n);
}

void GraftPlacing::work(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                        GraftPlacingState& state) const {
  const PlacingKind kind = held(tool);
  if (kind == PlacingKind::kPassingPin) lead_pin(hand, tool, bones, state);
  if (kind == PlacingKind::kClamp) use_clamp(hand, tool, bones, state);
  if (kind == PlacingKind::kScrew) turn_screw(hand, tool, bones, state);
}

void GraftPlacing::lead(const GraftPlacingState& state,
                        std::array<ToolGuide, kMaxHands>& guides) const {
  for (std::size_t n = 0; n < kMaxHands; ++n) {
    const PlacingHand& hand = state.hands[n];
    if (hand.line == PlacingLine::kNone) continue;
    ToolGuide& out = guides[n];
    if (hand.line == PlacingLine::kDraw) {
      out = line_along(plan_.femur, hand, false, 1);
      out.pulls = true;
      out.stop_m = hand.from_m + state.drawn_m;
      continue;
    }
    if (hand.line == PlacingLine::kScrew) {
      out = line_along(plan_.tibia, hand, false, 1);
      out.p_B = state.screw.p_B;
      out.nhat_B = state.screw.out_B;
      out.in_hole = out.stops = true;
      out.stop_m = -state.screw.in_m;
      continue;
    }
    const bool pin = hand.line == PlacingLine::kPin;
    out = line_along(pin ? plan_.femur : plan_.tibia, hand, true, pin ? -1 : 1);
    out.in_hole = true;
    out.stops = pin;
    out.stop_m = pin ? -state.pin_m : 0;
  }
}

void GraftPlacing::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                        GraftPlacingState& state) const {
  count_cycles(bones.bend, state);
  const auto count = static_cast<std::uint32_t>(std::min(tools.size(), kMaxHands));
  for (std::uint32_t hand = 0; hand < count; ++hand) {
    const ToolState& tool = *tools[hand];
    PlacingHand& h = state.hands[hand];
    const bool here = tool.epoch == bones.epoch;
    if (h.instrument != tool.instrument || !here) {
      if (h.line == PlacingLine::kPin && state.phase == PlacingPhase::kEmpty) state.pin_m = 0;
      if (h.line == PlacingLine::kScrew && here) let_go_screw(h, bones, state);
      // A clamp that is put away has let go.
      if (here && h.instrument != 0xffffffffu) open(hand, tool, bones, state);
      h = {};
      h.instrument = here ? tool.instrument : 0xffffffffu;
      continue;
    }
    if (is_finite(tool.X_WP) && is_finite(tool.X_WD) && is_finite(tool.force_W))
      work(hand, tool, bones, state);
  }
}

}  // namespace osteon
