#include "osteon/haptic/haptic.h"

#include <algorithm>
#include <cmath>

#include "band_pull.h"
#include "contact_field.h"
#include "coupling.h"
#include "friction.h"
#include "grab_force.h"
#include "guide_pull.h"
#include "input_checks.h"
#include "load.h"
#include "made_portals.h"
#include "osteon/base/check.h"
#include "osteon/haptic/haptic_state.h"
#include "osteon/haptic/snapshot_age.h"
#include "portal_pivot.h"
#include "proxy_solver.h"
#include "rigid_motion.h"

namespace osteon {
namespace {

constexpr double kAnyWay = 1e9;
constexpr double kFallsOn_m = 1e-4;  // in a tick: 100 mm/s
// A tip goes no farther in a tick while its shaft is in a portal: 0.5 m/s.
constexpr double kStepInPortal_m = 0.0005;
constexpr double kMostSqueeze = 3;  // D: share of a contact in the felt force
constexpr double kFadeTicks = HapticLoop::kFade_s / 0.001;

}  // namespace

struct HapticLoop::Impl {
  std::shared_ptr<const Case> the_case;
  std::shared_ptr<const Tool> tool;
  ContactField field;
  ProxySolver solver;
  BandPull bands;
  std::vector<Portal> portals;
  std::size_t first_made = 0;              // those before are the case's own
  const BandContacts* contacts = nullptr;  // null: nothing soft is felt
  HapticState state;
  std::array<Pose, kMaxBones> now_WB{};
  std::array<BoneMotion, kMaxBones> motion{};
  OtherTools others{};           // as this tick sees them
  Vec3 v_hand_W = Vec3::Zero();  // of this tick's sample
  std::uint32_t own = 0;         // number of its hand in the session
  ToolGuide guide;               // of this tick
  bool waiting = false;          // for bones of the tool's own epoch

  Impl(std::shared_ptr<const Case> c, std::shared_ptr<const Tool> t,
       std::span<const std::shared_ptr<const Tool>> tray)
      : the_case(std::move(c)),
        tool(std::move(t)),
        field(*the_case, *tool),
        solver(field, *tool, tray),
        bands(*tool) {
    state.bone_count = static_cast<std::uint32_t>(the_case->bones.size());
    state.pairs.resize(kMaxCandidates);
  }

  std::span<const Pose> before() const { return {state.X_WB.data(), state.bone_count}; }
  std::span<const Pose> now() const { return {now_WB.data(), state.bone_count}; }

  void refuse_input();
  void see_bones(const BoneSnapshot& bones, double age_s);
  void see_others(const OtherTools& seen);
  void see_guide(const BoneSnapshot& bones);
  GuidePull led(const ToolInput& input, const Pose& X_WD, const HapticParams& params) const;
  void place(const Pose& X_WD);
  void wait_for_epoch(std::uint32_t bones_epoch);
  void start_fading() { state.fade_n = state.tool.force_W.norm() / kFadeTicks; }
  void fade();
  void grab(const ToolInput& input, const Pose& X_WD, const HapticParams& params);
  void follow(const ToolInput& input, const Pose& X_WD, const HapticParams& params);
  PortalPivot pivot(const ToolInput& input, const Pose& X_WD, const HapticParams& params);
  Vec3 pull_of_bands(const Pose& before_WP, const HapticParams& params);
  void aim_through(const PortalPivot& pivot, const Vec3& base_W, Pose& wanted) const;
  void see_made_portals();
  std::uint32_t let_in() const;
  std::uint32_t made_in_use() const;
  void pass_portals(const Pose& X_WD, bool start);
  PortalHold still_in(std::uint32_t portal) const;
  Vec3 carried_base() const;
  double reach(const Vec3& base_W, const Vec3& hand_W, double turn_rad) const;
  double glide(const Vec3& hand_W) const;
  LoadScene scene(const HapticParams& params) const {
    return {field, motion, others, v_hand_W, params};
  }
  void list_contacts(const ProxyMove& move);
  Load letting_go(const HapticParams& params) const;
  Friction in_hole(const Friction& on_surface) const;
  double feel(const ToolInput& input, const Vec3& hand_W, const Load& held, bool sticking,
              const Vec3& beside_W, const HapticParams& params);
  void share_force(const ProxyMove& move, const Load& load, const Vec3& beside_W);
};

void HapticLoop::Impl::refuse_input() {
  state.tool.status = kTickInputNotFinite;
  state.tool.force_W.setZero();
  state.tool.contact_count = 0;
  state.tool.tool_contact_count = 0;
  state.fade_n = 0;
}

void HapticLoop::Impl::see_bones(const BoneSnapshot& bones, double age_s) {
  const double age = std::isfinite(age_s) ? std::clamp(age_s, 0.0, kOldestSnapshot_s) : 0.0;
  for (std::uint32_t i = 0; i < state.bone_count; ++i) {
    motion[i] = i < bones.count ? bones.bones[i] : BoneMotion{the_case->bones[i].X_WB};
    motion[i].X_WB = now_WB[i] = carried_forward(motion[i], age);
  }
}

// One that is not finite is not there.
void HapticLoop::Impl::see_others(const OtherTools& seen) {
  others = seen;
  for (OtherTool& other : others)
    if (!usable(other.X_WP) || !is_finite(other.p_WD) || !is_finite(other.v_W)) other = {};
}

// A line that is not finite, or of another instrument, leads nothing.
void HapticLoop::Impl::see_guide(const BoneSnapshot& bones) {
  guide = bones.guides[own];
  const bool usable_line = guide.bone < state.bone_count && is_finite(guide.p_B) &&
                           is_finite(guide.nhat_B) && std::isfinite(guide.stop_m) &&
                           guide.grip >= 0 && guide.grip <= 1 && guide.give_m_per_n >= 0;
  guide.on = guide.on && usable_line && guide.instrument == state.tool.instrument &&
             bones.epoch == state.tool.epoch;
  field.set_guide(guide.on ? &guide : nullptr);
}

GuidePull HapticLoop::Impl::led(const ToolInput& input, const Pose& X_WD,
                                const HapticParams& params) const {
  if (!guide.on) return {};
  const Pose& X_WB = now_WB[guide.bone];
  const Vec3 v_W = velocity_at(motion[guide.bone], X_WB * guide.p_B);
  return pull_of(guide, X_WB, v_W,
                 {X_WD, input.v_W, params.stiffness_n_per_m, params.damping_n_s_per_m});
}

// Before the hand has been free once, nothing is felt: a start inside bone must not kick. The
// proxy is put out of the bone where there is room within reach.
void HapticLoop::Impl::place(const Pose& X_WD) {
  constexpr double kNear = 0.001;
  constexpr double kFar = 0.020;
  Pose at = X_WD;
  if (state.portal.portal != kNoPortal)
    at.q = through_portal(portals[state.portal.portal], tool->shaft, at.p, at.q);
  ProxyTask task{at, at.p, at.p, at.q, kNear, false, now(), now(), &others, &others, nullptr};
  ProxyMove move = solver.move(task, state.pairs);
  if (move.status & kTickProxyBlocked) {
    task.reach_m = kFar;
    move = solver.move(task, state.pairs);
  }
  fade();
  state.armed = move.free && state.fade_n == 0 && !waiting;
  state.sliding = false;
  state.rub = {};
  state.carrier = {};
  state.tool.X_WP = {move.end(), move.q_WP};
  state.tool.status |= move.status;
  list_contacts(move);
  pass_portals(X_WD, true);
}

// One that is no more, as after a restore point, lets go.
void HapticLoop::Impl::see_made_portals() {
  for (std::size_t i = first_made; i < portals.size(); ++i) {
    see_made_portal(contacts, now(), portals[i]);
    if (portals[i].open) continue;
    if (state.portal.portal == i) state.portal = {};
    if (state.tool.portal == i) state.tool.portal = kNoPortal;
  }
}

// The made portal through which a patch of skin lets the tool.
std::uint32_t HapticLoop::Impl::let_in() const {
  if (first_made == portals.size() || !contacts) return kNoPortal;
  if (contacts->instrument != state.tool.instrument || contacts->epoch != state.tool.epoch)
    return kNoPortal;
  return entered_portal(*contacts, portals, first_made);
}

void HapticLoop::Impl::pass_portals(const Pose& X_WD, bool start) {
  if (!portals.empty() && tool->shaft.radius > 0)
    follow_portals(portals, tool->shaft, state.tool.X_WP, X_WD, start, let_in(), state.portal);
  if (state.portal.portal != kNoPortal || !(state.portal.grip > 0))
    state.tool.portal = state.portal.portal;
  state.tool.p_portal_W.setZero();
  state.tool.portal_way = 0;
  if (state.tool.portal >= portals.size()) return;
  const Portal& portal = portals[state.tool.portal];
  state.tool.p_portal_W = portal.p_W;
  if (portal.made != kNotMade && !portal.bare) state.tool.portal_way = portal.pierced ? 2 : 1;
}

// A hand that begins anew where it is, with this instrument or another, is in the portal that it
// was in: how its device turns the shaft says nothing of that. The skin closes about the shaft
// again.
PortalHold HapticLoop::Impl::still_in(std::uint32_t portal) const {
  PortalHold hold;
  if (portal < portals.size() && tool->shaft.radius > 0) hold.portal = portal;
  return hold;
}

PortalPivot HapticLoop::Impl::pivot(const ToolInput& input, const Pose& X_WD,
                                    const HapticParams& params) {
  const PortalHand hand{X_WD, input.v_W, params.stiffness_n_per_m, params.damping_n_s_per_m,
                        params.friction_scale};
  return pivot_in(portals, tool->shaft, hand, state.portal);
}

// A shaft in a portal: its tip follows in short steps, and it is turned so that it passes the
// portal when the tip is where it will be. Bone lets the tip go where it is already.
void HapticLoop::Impl::aim_through(const PortalPivot& pivot, const Vec3& base_W,
                                   Pose& wanted) const {
  wanted.p = pivot.p_W;
  const Vec3 step = pivot.p_W - base_W;
  const double way = step.norm();
  const bool far = way > kStepInPortal_m;
  if (far && !state.carrier.valid()) wanted.p = base_W + (kStepInPortal_m / way) * step;
  const Vec3& tip_W = state.carrier.valid() ? base_W : wanted.p;
  wanted.q = through_portal(portals[state.portal.portal], tool->shaft, tip_W, pivot.q_W);
}

// Hand and world go back to a restore point in ticks of their own. Until both have, what the hand
// would feel is not where it will be.
void HapticLoop::Impl::wait_for_epoch(std::uint32_t bones_epoch) {
  waiting = bones_epoch != state.tool.epoch;
  if (!waiting || !state.armed) return;
  state.armed = false;
  start_fading();
}

// What is left of the force of before a change goes to zero in equal steps.
void HapticLoop::Impl::fade() {
  Vec3& force_W = state.tool.force_W;
  const double size = force_W.norm();
  if (!(state.fade_n > 0) || !(size > state.fade_n)) {
    force_W.setZero();
    state.fade_n = 0;
    return;
  }
  force_W *= (size - state.fade_n) / size;
  state.tool.status |= kTickFading;
}

// While the hand drags what it has grabbed, the surface that it would touch is the one that moves:
// nothing is touched, and the hand feels how far it has dragged. Contact begins anew afterwards.
void HapticLoop::Impl::grab(const ToolInput& input, const Pose& X_WD, const HapticParams& params) {
  if (!state.grabbing) state.p_WG = X_WD.p;
  state.grabbing = true;
  state.armed = false;
  state.sliding = false;
  state.carrier = {};
  state.tool.X_WP = X_WD;
  state.portal = {};
  state.rub = {};
  state.tool.portal = kNoPortal;
  state.tool.p_portal_W.setZero();
  state.tool.portal_way = 0;
  state.tool.contact_count = 0;
  state.tool.tool_contact_count = 0;
  state.fade_n = 0;
  state.tool.status |= kTickGrabbing;
  const Vec3 force =
      grab_force(X_WD.p - state.p_WG, input.v_W, params.grab_n_per_m, params.damping_n_s_per_m);
  const ForceLimits limits{params.max_force_n, params.max_slew_n_per_s * params.tick_s};
  const Vec3 limited = limited_force(force, state.tool.force_W, limits, state.tool.status);
  state.tool.force_W = params.force_on ? limited : Vec3(Vec3::Zero());
}

// The proxy's last place, moved along with the bone that it rests on.
Vec3 HapticLoop::Impl::carried_base() const {
  const Vec3& p_W = state.tool.X_WP.p;
  if (!state.carrier.valid()) return p_W;
  const Pose& before_WB = state.X_WB[state.carrier.index];
  const Pose& X_WB = now_WB[state.carrier.index];
  return same_pose(before_WB, X_WB) ? p_W : X_WB * (before_WB.inverse() * p_W);
}

// How far the proxy may go in this tick: to the hand and around what lies between, but no farther
// than a brisk hand needs, so that few pieces come into question.
double HapticLoop::Impl::reach(const Vec3& base_W, const Vec3& hand_W, double turn_rad) const {
  constexpr double kBrisk = 0.002;
  constexpr double kRoom = 0.0005;
  const double way = (hand_W - base_W).norm();
  const double hand_step = (hand_W - state.tool.X_WD.p).norm();
  double pushed = 0;
  for (std::uint32_t i = 0; i < state.bone_count; ++i)
    if (!same_pose(state.X_WB[i], now_WB[i]))
      pushed = std::max(pushed, travel(state.X_WB[i], now_WB[i], base_W, field.tool_radius()));
  return std::min(2 * way, std::max(kBrisk, 2 * hand_step)) + kRoom + 2 * pushed +
         turn_rad * field.tool_radius();
}

// How far a proxy in contact may go in this tick: ahead of the hand's own speed by half of it and
// 10 mm/s more.
double HapticLoop::Impl::glide(const Vec3& hand_W) const {
  constexpr double kCreep = 1e-5;
  return kCreep + 1.5 * (hand_W - state.tool.X_WD.p).norm();
}

void HapticLoop::Impl::list_contacts(const ProxyMove& move) {
  // The points were found with the proxy at query_W; they belong to the tool's surface.
  const Vec3 shift = state.tool.X_WP.p - move.query_W;
  std::uint32_t& bones = state.tool.contact_count = 0;
  std::uint32_t& tools = state.tool.tool_contact_count = 0;
  for (std::uint32_t i = 0; i < move.holding_count; ++i) {
    const HoldingPlane& plane = move.holding[i];
    if (plane.other < kMaxHands) {
      state.tool.tool_contacts[tools++] = {plane.other, plane.p_W + shift, plane.nhat_BT_W,
                                           Vec3::Zero()};
      continue;
    }
    const PiecePair& pair = field.pairs()[plane.pair];
    state.tool.contacts[bones++] = {BoneId{pair.bone}, pair.piece,  plane.p_W + shift,
                                    plane.nhat_BT_W,   plane.depth, Vec3::Zero()};
  }
}

// Splits the force on the hand among the contacts: the part along the load's normal as the planes'
// weights say, the rest (friction) in the same proportion. Between two walls that face each other
// the weights grow without bound as their angle closes, more than such planes are known: no contact
// gets more than kMostSqueeze times what the hand feels, which a wedge of 19 degrees gives.
void HapticLoop::Impl::share_force(const ProxyMove& move, const Load& load, const Vec3& beside_W) {
  const Vec3 force = state.tool.force_W - beside_W;
  const double size = load.stretch_W.norm();
  if (!(load.sum > 0) || !(size > 0)) return;
  const double normal = std::max(0.0, force.dot(load.nhat_W));
  const Vec3 rest = force - normal * load.nhat_W;
  std::uint32_t bones = 0, tools = 0;
  for (std::uint32_t i = 0; i < move.holding_count; ++i) {
    const HoldingPlane& plane = move.holding[i];
    const double weight = std::min(plane.weight, kMostSqueeze * size);
    Vec3& share = plane.other < kMaxHands ? state.tool.tool_contacts[tools++].force_on_tool_W
                                          : state.tool.contacts[bones++].force_on_tool_W;
    share = (normal * weight / size) * plane.nhat_BT_W + (plane.weight / load.sum) * rest;
  }
}

void HapticLoop::Impl::follow(const ToolInput& input, const Pose& X_WD,
                              const HapticParams& params) {
  const GuidePull line = led(input, X_WD, params);
  // Of a shaft that is led the skin feels nothing more.
  const PortalPivot portal = line.in ? PortalPivot{} : pivot(input, X_WD, params);
  const Vec3 base_W = carried_base();
  Pose wanted = X_WD;
  if (line.in) wanted = {line.p_W, line.q_W};
  if (portal.in) aim_through(portal, base_W, wanted);
  const Quat q = turned_towards(state.tool.X_WP.q, wanted.q, params.max_turn_rad_per_tick);
  // Of a whole instrument the farthest end would go far in the widest turn.
  const double turn =
      field.whole() ? angle_between(state.tool.X_WP.q, q) : params.max_turn_rad_per_tick;
  double room = reach(base_W, wanted.p, turn);
  if (portal.in) room = std::min(room, kStepInPortal_m);
  const bool was_held = state.carrier.valid();
  ProxyTask task{state.tool.X_WP, base_W, wanted.p,      q,       room,   was_held,
                 before(),        now(),  &state.others, &others, nullptr};
  PortalRing ring;
  if (portal.in) {
    ring = ring_of(portals[state.portal.portal], tool->shaft, state.tool.X_WP);
    task.ring = &ring;
  }
  if (line.in) {
    ring = ring_about_line(line.line_W, line.along_W, state.tool.X_WP);
    task.ring = &ring;
  }
  const ProxyMove move = solver.move(task, state.pairs);
  Load held = load_of(move, scene(params));
  const bool way_known = !(move.status & kTickSolverLimit);
  if (was_held && way_known && !held.holds()) held = letting_go(params);

  // A proxy that has just landed has no place yet to which friction could hold it.
  // What turns under power slips already: bone that goes from before it must not have to pull it.
  const bool turns = state.tool.power > 0 && field.can_be_cut();
  const bool held_before = was_held && held.carrier.valid();
  const bool rested = held_before && !turns;
  Friction friction{0, 0, kAnyWay};
  // When the last of the bone before it is gone, it falls on to the hand: in a slope, not at once.
  if (held_before && turns) friction.glide_m = glide(wanted.p) + kFallsOn_m;
  if (rested) friction = {held.static_lag, held.dynamic_lag, glide(wanted.p)};
  if (rested && line.in && guide.in_hole) friction = in_hole(friction);
  const std::span<const Vec3> path(move.path.data(), move.path_count);
  const FrictionStep step = apply_friction(path, friction, state.sliding);
  if (move.free && step.p_W == wanted.p) {
    held.carrier = {};
    held.by_tool = false;
  }
  state.sliding = step.sliding;
  state.carrier = held.carrier;
  const Pose before_WP = state.tool.X_WP;
  state.tool.X_WP = {step.p_W, move.q_WP};
  state.tool.status |= move.status | (step.sticking ? kTickSticking : kTickOk);
  list_contacts(move);
  Vec3 beside_W = line.in ? line.force_W : portal.force_W;
  beside_W += pull_of_bands(before_WP, params);
  const double kept = feel(input, wanted.p, held, step.sticking, beside_W, params);
  share_force(move, held, kept * beside_W);
  pass_portals(X_WD, false);
}

std::uint32_t HapticLoop::Impl::made_in_use() const {
  const std::uint32_t portal = state.portal.portal;
  return portal < portals.size() ? portals[portal].made : kNotMade;
}

// Soft bands push the tool where it is: bone and other tools alone bound its way.
Vec3 HapticLoop::Impl::pull_of_bands(const Pose& before_WP, const HapticParams& params) {
  if (!bands.any()) {
    state.rub = {};
    return Vec3::Zero();
  }
  const ToolState& t = state.tool;
  const PullingHand hand{t.X_WP,
                         before_WP,
                         v_hand_W,
                         t.instrument,
                         t.epoch,
                         params.stiffness_n_per_m,
                         params.damping_n_s_per_m,
                         made_in_use(),
                         state.portal.grip};
  const BandForce pulled = bands.force(hand, before(), now());
  const double scale = params.friction_scale;
  RubNow rubbed{pulled.rests_W, scale * pulled.resting_n, scale * pulled.sliding_n,
                pulled.way_W,   params.stiffness_n_per_m, params.damping_n_s_per_m,
                params.tick_s};
  return pulled.force_W + rub(rubbed, state.rub);
}

// The hand has a free way to go, but the proxy may still be gliding after it, around an edge.
Load HapticLoop::Impl::letting_go(const HapticParams& params) const {
  Load out;
  out.carrier = state.carrier;
  const Material& material = field.bone(out.carrier.index).material;
  out.stiffness = std::min(params.stiffness_n_per_m, material.stiffness_n_per_m);
  out.v_bone_W = velocity_at(motion[out.carrier.index], state.tool.X_WP.p);
  return out;
}

// A hole's end holds against the push, across the way that the hole leaves: its friction does not
// stop a tip that goes on along the hole. What sticks there is the grain of the wall, which lets go
// after a way much shorter than a cell of the bone: the tip goes on in small slips.
Friction HapticLoop::Impl::in_hole(const Friction& on_surface) const {
  constexpr double kGrain_m = 5e-5;  // own default
  const double least = std::min(on_surface.static_lag_m, kGrain_m);
  const double share = on_surface.static_lag_m > 0 ? least / on_surface.static_lag_m : 0;
  return {least, share * on_surface.dynamic_lag_m, on_surface.glide_m};
}

// Sets the force on the hand from the place that the proxy has taken, and what comes beside it of
// portal and bands. Returns what share of it the limits have left.
double HapticLoop::Impl::feel(const ToolInput& input, const Vec3& hand_W, const Load& held,
                              bool sticking, const Vec3& beside_W, const HapticParams& params) {
  Vec3 force = Vec3::Zero();
  if (held.holds()) {
    const Vec3 stretch = state.tool.X_WP.p - hand_W;
    const double size = stretch.norm();
    const bool loaded = held.sum > 0 || !(size > 0);
    force = coupling_force({held.stiffness, params.damping_n_s_per_m, stretch,
                            loaded ? held.nhat_W : Vec3(stretch / size), held.v_bone_W, input.v_W,
                            sticking});
  }
  const ForceLimits limits{params.max_force_n, params.max_slew_n_per_s * params.tick_s};
  if (!beside_W.isZero(0)) force += beside_W;
  const double wanted = force.norm();
  force = limited_force(force, state.tool.force_W, limits, state.tool.status);
  state.tool.force_W = params.force_on ? force : Vec3(Vec3::Zero());
  return wanted > 0 ? std::min(1.0, state.tool.force_W.norm() / wanted) : 1;
}

HapticLoop::HapticLoop(std::shared_ptr<const Case> the_case, std::shared_ptr<const Tool> tool,
                       std::span<const std::shared_ptr<const Tool>> tray) {
  demand(the_case && tool && the_case->bones.size() <= kMaxBones,
         "the haptic loop needs a tool and a case of at most kMaxBones bones");
  impl_ = std::make_unique<Impl>(std::move(the_case), std::move(tool), tray);
}

HapticLoop::~HapticLoop() = default;
HapticLoop::HapticLoop(HapticLoop&&) noexcept = default;

const ToolState& HapticLoop::tick(const ToolInput& input, const BoneSnapshot& bones,
                                  double bones_age_s, const HapticParams& params,
                                  const OtherTools& others) noexcept {
  Impl& in = *impl_;
  ToolState& out = in.state.tool;
  ++out.tick;
  out.time_s = static_cast<double>(out.tick) * params.tick_s;
  const std::size_t seen = std::min<std::size_t>(bones.count, in.state.bone_count);
  if (!usable(input) || !usable(bones, seen)) {
    in.refuse_input();
    return out;
  }
  out.status = kTickOk;
  out.buttons = input.buttons;
  const Pose X_WD{input.X_WD.p, input.X_WD.q.normalized()};
  in.see_bones(bones, bones_age_s);
  in.see_others(others);
  in.see_guide(bones);
  in.see_made_portals();
  in.wait_for_epoch(bones.epoch);
  in.v_hand_W = out.v_W = input.v_W;
  if (params.grab_n_per_m > 0) {
    in.grab(input, X_WD, params);
  } else if (in.state.armed) {
    in.follow(input, X_WD, params);
  } else {
    in.place(X_WD);
  }
  in.state.grabbing = params.grab_n_per_m > 0;
  out.X_WD = X_WD;
  std::copy_n(in.now_WB.begin(), in.state.bone_count, in.state.X_WB.begin());
  in.state.others = in.others;
  return out;
}

void HapticLoop::reset() {
  HapticState fresh;
  fresh.bone_count = impl_->state.bone_count;
  fresh.pairs.resize(kMaxCandidates);
  impl_->state = std::move(fresh);
}

void HapticLoop::begin_anew(const ToolState& last) noexcept {
  HapticState& s = impl_->state;
  s.tool = last;
  s.tool.contact_count = 0;
  s.tool.tool_contact_count = 0;
  s.armed = s.sliding = s.grabbing = false;
  s.carrier = {};
  s.portal = impl_->still_in(last.portal);
  s.rub = {};
  s.tool.portal = kNoPortal;
  s.p_WG.setZero();
  s.others = {};
  std::fill(s.pairs.begin(), s.pairs.end(), PairMemory{});
  impl_->start_fading();
}

void HapticLoop::next_epoch() noexcept { ++impl_->state.tool.epoch; }

void HapticLoop::set_grip(std::uint32_t instrument, double power, double jaw) noexcept {
  ToolState& tool = impl_->state.tool;
  tool.instrument = instrument;
  tool.power = power;
  tool.jaw = jaw;
}

const HapticState& HapticLoop::state() const { return impl_->state; }
const Tool& HapticLoop::tool() const { return *impl_->tool; }

std::uint64_t HapticLoop::state_hash() const { return hash_of(impl_->state); }

void HapticLoop::set_portals(std::vector<Portal> portals) {
  impl_->portals = std::move(portals);
  const auto& all = impl_->portals;
  const auto first = std::find_if(all.begin(), all.end(),
                                  [](const Portal& portal) { return portal.made != kNotMade; });
  impl_->first_made = static_cast<std::size_t>(first - all.begin());
  for (std::size_t i = impl_->first_made; i < all.size(); ++i)
    demand(all[i].made == i - impl_->first_made && all[i].made < kMaxMade,
           "portals that are made stand at the end, by their numbers");
}

void HapticLoop::set_cuts(std::span<const CutField* const> by_bone) {
  impl_->field.set_cuts(by_bone);
}

void HapticLoop::set_hand(std::uint32_t hand) {
  demand(hand < kMaxHands, "a session has at most kMaxHands hands");
  impl_->own = hand;
}

void HapticLoop::set_bands(const std::vector<SoftBand>* bands, const BandContacts* contacts,
                           const SoftFriction& friction) {
  impl_->contacts = contacts;
  impl_->bands.set(bands, contacts, friction);
}

std::unique_ptr<HapticState> HapticLoop::save() const {
  return std::make_unique<HapticState>(impl_->state);
}

void HapticLoop::restore(const HapticState& state) {
  demand(state.bone_count == impl_->state.bone_count &&
             state.pairs.size() == impl_->state.pairs.size(),
         "a haptic state can be restored only into a loop over the same case and tool");
  impl_->state = state;
}

}  // namespace osteon
