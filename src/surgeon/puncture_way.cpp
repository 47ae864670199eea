#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "acl_knee.h"
#include "hand_way.h"
#include "open_sight.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/scene/marks_now.h"
#include "osteon/surgeon/puncture_surgeon.h"
#include "osteon/surgeon/scope_reach.h"

namespace osteon {
namespace {

constexpr double kOverSkin_m = 0.04;
constexpr double kCutHalf_m = 0.0055, kBladeDeep_m = 0.011;  // 7 mm go around the trocar
constexpr double kCutStroke_m_per_s = 0.012, kPuncture_m_per_s = 0.02;
constexpr double kTrocarDeep_m = 0.028, kTrocarRadius_m = 0.00275, kTrocarRoom_m = 0.0015;
constexpr double kNeedleDeep_m = 0.022, kNeedle_s = 0.8;
constexpr double kLookScope_m = 0.002, kScopeIn_m = 0.018;
constexpr double kLookDeep_m = 0.006;  // under the skin of the other portal
constexpr double kLooked_s = 2.2, kHook_s = 1.5;
constexpr double kHookRadius_m = 0.0015, kHookBefore_m = 0.004, kHookPress_m = 0.0015;
// So far ahead of the skin a hand goes that breaks through with what it is made to feel.
constexpr double kForcedDeep_m = 0.041;
constexpr double kBreaksDeep_m = 0.018;    // under the skin at rest, about where it breaks then
constexpr double kWrong_m = 0.0085;        // beside the place, of an error
constexpr double kTrocarPlunge_m = 0.024;  // beyond the bone's surface
constexpr double kBeside_m = 0.25;         // where a hand waits

constexpr std::array<std::string_view, 7> kPunctureFaults{
    "al_low", "al_midline", "al_lateral", "am_medial", "forced", "plunged", "am_blind"};

// A place on the skin, and the way from there into the joint.
struct SkinWay {
  Vec3 p_W = Vec3::Zero();
  Vec3 n_W = Vec3::UnitZ();  // out of the skin
  Vec3 up_W = Vec3::UnitX();
  Vec3 in_W = -Vec3::UnitZ();
  Pose along(double deep_m) const { return held_by_shaft(p_W + deep_m * in_W, -in_W); }
};

// A knee with its skin, and how somebody works on it.
struct Puncture {
  const Case& the_case;
  AclKnee knee;
  MeshDistance skin_at_rest;
  Pose X_moved;  // of the skin about both portals, away from rest
  PortalFrame al, am;
  std::string fault;
  double pace = 1;
  Vec3 on_skin(const Vec3& p_W) const {
    return X_moved * skin_at_rest.closest(X_moved.inverse() * p_W).point;
  }
};

const SoftPart* skin_of_case(const Case& the_case) {
  for (const SoftPart& part : the_case.softs)
    if (part.kind == "skin" && !part.mesh_W.triangles.empty()) return &part;
  return nullptr;
}

// `the_case`: as it begins.
Result<Puncture> puncture_of(const Case& at_rest, const Case& the_case, const Skill& skill) {
  auto knee = AclKnee::make(the_case);
  if (!knee) return tl::unexpected(knee.error());
  const SoftPart* skin = skin_of_case(at_rest);
  const auto al = find_landmark(the_case, "portal_al"), am = find_landmark(the_case, "portal_am");
  const auto al_frame = al ? portal_frame(the_case, *al) : std::nullopt;
  const auto am_frame = am ? portal_frame(the_case, *am) : std::nullopt;
  if (!skin || !al_frame || !am_frame)
    return fail("the case has no skin with both portals", the_case.name,
                "Use a generated knee, such as builtin:knee");
  const Pose X_moved = moved_from_rest(at_rest, *al, begun_bones(at_rest));
  Puncture out{
      the_case, std::move(*knee), MeshDistance(skin->mesh_W), X_moved, *al_frame, *am_frame, {}};
  if (skill.name.starts_with("bad:")) out.fault = skill.name.substr(4);
  if (!out.fault.empty() &&
      std::find(kPunctureFaults.begin(), kPunctureFaults.end(), out.fault) == kPunctureFaults.end())
    return fail("no virtual surgeon can make the error '" + out.fault + "'", "surgeon");
  out.pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  return out;
}

// The steepest way into the joint on which a trocar meets no bone.
std::optional<Vec3> free_way(const Puncture& at, const Vec3& p_W, const Vec3& n_W) {
  constexpr int kRound = 16;
  const Vec3 middle = 0.5 * (at.knee.mark("acl_femur") + at.knee.mark("acl_tibia"));
  const Vec3 to = (middle - p_W).normalized(), x = to.unitOrthogonal(), y = to.cross(x);
  for (const double lean : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
    for (int k = 0; k < (lean > 0 ? kRound : 1); ++k) {
      const double angle = 2 * std::numbers::pi * k / kRound;
      const Vec3 in =
          (to + std::tan(lean) * (std::cos(angle) * x + std::sin(angle) * y)).normalized();
      if (in.dot(n_W) > -0.5) continue;
      if (at.knee.is_free(p_W, p_W + kTrocarDeep_m * in, kTrocarRadius_m + kTrocarRoom_m))
        return in;
    }
  return std::nullopt;
}

// At the landmark or beside it, on the skin.
Result<SkinWay> skin_way(const Puncture& at, const PortalFrame& frame, const Vec3& beside_W) {
  SkinWay out;
  out.p_W = at.on_skin(frame.p_W + beside_W);
  out.n_W = -frame.in_W;
  out.up_W = frame.up_W;
  const auto in = free_way(at, out.p_W, out.n_W);
  if (!in)
    return fail("no way through the skin into the joint is free", at.the_case.name,
                "Use another patient");
  out.in_W = *in;
  return out;
}

// Along the limb, the blade in the plane of its stroke.
void cut_skin(const Puncture& at, const SkinWay& in, HandWay& way) {
  Mat3 axes;
  axes.col(0) = in.up_W;
  axes.col(2) = in.n_W;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Quat q(axes);
  const Vec3 from = at.on_skin(in.p_W - kCutHalf_m * in.up_W);
  const Vec3 to = at.on_skin(in.p_W + kCutHalf_m * in.up_W);
  const auto place = [&](const Vec3& p_W, double deep_m) { return Pose{p_W - deep_m * in.n_W, q}; };
  way.go(place(from, -kOverSkin_m), kHandCarry_m_per_s);
  way.go(place(from, -0.003), kHandCarry_m_per_s);
  way.go(place(from, kBladeDeep_m), kPuncture_m_per_s);
  way.go(place(to, kBladeDeep_m), kCutStroke_m_per_s);
  way.go(place(to, -kOverSkin_m), kHandNear_m_per_s);
}

// From the trocar's place on towards the nearest bone.
void plunge_trocar(const Puncture& at, const SkinWay& in, HandWay& way) {
  const Vec3 tip = in.p_W + kTrocarDeep_m * in.in_W;
  const Vec3 on = at.knee.on_femur(tip);
  way.go(held_by_shaft(on + kTrocarPlunge_m * (on - tip).normalized(), -in.in_W),
         kHandNear_m_per_s);
  way.stay(0.6);
  way.go(in.along(kTrocarDeep_m), kHandNear_m_per_s);
}

// The same way, moved along the skin so that a tip that is so deep is under the place itself.
SkinWay aimed_deep(SkinWay in, double deep_m) {
  in.p_W -= deep_m * (in.in_W / -in.in_W.dot(in.n_W) + in.n_W);
  return in;
}

void push_trocar(const Puncture& at, const SkinWay& place, const std::string& fault, HandWay& way) {
  const SkinWay in = fault == "forced" ? aimed_deep(place, kBreaksDeep_m) : place;
  way.take("trocar_blunt");
  way.go(in.along(-kOverSkin_m), kHandCarry_m_per_s);
  way.go(in.along(-0.002), kHandCarry_m_per_s);
  way.go(in.along(fault == "forced" ? kForcedDeep_m : kTrocarDeep_m), kPuncture_m_per_s);
  way.stay(0.5);
  if (fault == "plunged") plunge_trocar(at, in, way);
  way.go(in.along(-kOverSkin_m), kHandNear_m_per_s);
}

// Under the scope's eyes to where the trocar will go, and out again.
void push_needle(const SkinWay& in, HandWay& way) {
  way.take("spinal_needle");
  way.go(in.along(-kOverSkin_m), kHandCarry_m_per_s);
  way.go(in.along(-0.002), kHandCarry_m_per_s);
  way.go(in.along(kNeedleDeep_m), kPuncture_m_per_s);
  way.stay(kNeedle_s);
  way.go(in.along(-kOverSkin_m), kHandNear_m_per_s);
}

void make_portal(const Puncture& at, const SkinWay& in, const std::string& fault, HandWay& way) {
  if (fault != "forced") {
    way.take("scalpel_11");
    cut_skin(at, in, way);
  }
  push_trocar(at, in, fault, way);
}

// Beside the knee, on the portal's own side.
Pose puncture_wait(const PortalFrame& frame) {
  const Vec3 out = (-frame.in_W - 0.6 * frame.middle_W).normalized();
  return held_by_shaft(frame.p_W + kBeside_m * out, out);
}

// With the hook onto the tibia's footprint, or as near to it as bone lets it.
Vec3 hooked(const Puncture& at, const SkinWay& in) {
  const Vec3 mark = at.knee.mark("acl_tibia"), back = (in.p_W - mark).normalized();
  for (double before_m = 0.003; before_m < 0.02; before_m += 0.001)
    if (at.knee.is_free(mark + before_m * back, in.p_W, kHookRadius_m))
      return mark + before_m * back;
  return in.p_W + kTrocarDeep_m * in.in_W;
}

// Where the scope shows the inside of the other portal: the shaft comes from its own, as steep as
// it can.
std::optional<Pose> looks_across(const Puncture& at, const SkinWay& from, const Vec3& to_W,
                                 const ScopeOptics& optics) {
  constexpr double kTurn = std::numbers::pi / 12;
  for (const double deep_m : {0.008, 0.0065, 0.005, 0.004})
    for (int turn = 0; turn <= 11; ++turn)
      for (const double side : {1.0, -1.0})
        for (const double mm : {16.0, 13.0, 19.0, 22.0, 11.0}) {
          const auto pose = pose_for({to_W, 1e-3 * mm, side * turn * kTurn}, from.p_W, optics);
          if (!pose || from.n_W.dot(from.p_W - pose->p) < deep_m) continue;
          if (!at.knee.is_free(pose->p, from.p_W, kLookScope_m + 0.0005)) continue;
          if (at.knee.is_free(pose->p, to_W, 0.0004)) return pose;
        }
  return std::nullopt;
}

// Where the scope shows a landmark and what is about it: nothing close before the window, where
// that can be, and nothing in the line of sight but what lies upon the landmark. Ends: all
// candidates are tried once, or twice.
std::optional<Pose> looks_at(const Puncture& at, const OpenSight& sight, const SkinWay& from,
                             const Vec3& mark_W, const ScopeOptics& optics) {
  constexpr double kTurn = std::numbers::pi / 12, kDeep_m = 0.008, kLiesUpon_m = 0.006;
  for (const bool open : {true, false})
    for (int turn = 0; turn <= 11; ++turn)
      for (const double side : {1.0, -1.0})
        for (const double mm : {22.0, 18.0, 26.0, 15.0, 30.0}) {
          const auto pose = pose_for({mark_W, 1e-3 * mm, side * turn * kTurn}, from.p_W, optics);
          if (!pose || from.n_W.dot(from.p_W - pose->p) < kDeep_m) continue;
          if (!at.knee.is_free(pose->p, from.p_W, kLookScope_m + 0.0005)) continue;
          const ScopeView view = view_through(optics, *pose);
          if (open && !sight.is_open(view, optics)) continue;
          const Vec3 back = (view.eye_W - mark_W).normalized();
          if (sight.is_in_sight(view.eye_W, mark_W + kLiesUpon_m * back)) return pose;
        }
  return std::nullopt;
}

// From where the shaft stands straight in its portal aside about the portal.
void turn_aside(const SkinWay& in, const Pose& gaze, HandWay& way) {
  constexpr int kSteps = 10;
  const Pose from = way.pose();
  for (int k = 1; k <= kSteps; ++k) {
    const double f = static_cast<double>(k) / kSteps;
    const Vec3 p = from.p + f * (gaze.p - from.p);
    const Vec3 back = (in.p_W - p).normalized();
    Quat q = from.q.slerp(f, gaze.q).normalized();
    q = (turn_between(q * Vec3::UnitZ(), back) * q).normalized();
    way.go({p, q}, kPuncture_m_per_s);
  }
}

void bring_scope(const SkinWay& in, const Pose& gaze, HandWay& way) {
  way.go(in.along(-kOverSkin_m), kHandCarry_m_per_s);
  way.go(in.along(-0.002), kHandCarry_m_per_s);
  way.go(in.along(kScopeIn_m), kPuncture_m_per_s);
  turn_aside(in, gaze, way);
}

// With the hook to the tibia's footprint.
void end_hooked(const Puncture& at, const SkinWay& am, HandWay& worker) {
  worker.take("hook_probe");
  const Vec3 hook = hooked(at, am), back = (am.p_W - hook).normalized();
  worker.go(held_by_shaft(am.p_W + kOverSkin_m * back, back), kHandCarry_m_per_s);
  worker.go(held_by_shaft(hook, back), kPuncture_m_per_s);
  worker.stay(kHook_s);
}

void draw_scope_out(const Puncture& at, const SkinWay& al, HandWay& eye) {
  eye.go(al.along(kScopeIn_m), kHandNear_m_per_s);
  eye.go(al.along(-kOverSkin_m), kHandNear_m_per_s);
  eye.go(puncture_wait(at.al), kHandCarry_m_per_s);
}

// From one to the next by the middle, where the shaft stands straight.
void look_at_marks(const Puncture& at, const std::vector<std::string>& marks, const SkinWay& al,
                   const ScopeOptics& optics, const OpenSight& sight, HandWay& eye,
                   std::vector<std::string>& unseen) {
  for (const std::string& name : marks) {
    const auto gaze =
        at.knee.has_mark(name) ? looks_at(at, sight, al, at.knee.mark(name), optics) : std::nullopt;
    if (!gaze) {
      unseen.push_back(name);
      continue;
    }
    eye.go(al.along(kScopeIn_m), kHandNear_m_per_s);
    turn_aside(al, *gaze, eye);
    eye.stay(kLooked_s);
  }
}

// Straight through the portal onto each soft mark, and off it. Where bone is in the way none is
// felt.
void feel_soft_marks(const Puncture& at, const std::vector<std::string>& marks, const SkinWay& am,
                     HandWay& worker, std::vector<std::string>& unfelt) {
  for (const std::string& name : marks) {
    const Vec3 mark = at.knee.has_mark(name) ? at.knee.mark(name) : am.p_W;
    const Vec3 back = (am.p_W - mark).normalized();
    if (mark == am.p_W || !at.knee.is_free(mark + kHookBefore_m * back, am.p_W, kHookRadius_m)) {
      unfelt.push_back(name);
      continue;
    }
    const auto before = [&](double m) { return held_by_shaft(mark + m * back, back); };
    worker.go(held_by_shaft(am.p_W + kOverSkin_m * back, back), kHandCarry_m_per_s);
    worker.go(before(kHookBefore_m), kHandNear_m_per_s);
    worker.go(before(-kHookPress_m), kPuncture_m_per_s);
    worker.stay(kHook_s);
    worker.go(before(kHookBefore_m), kPuncture_m_per_s);
    worker.go(held_by_shaft(am.p_W + kOverSkin_m * back, back), kHandNear_m_per_s);
  }
}

}  // namespace

std::span<const std::string_view> puncture_faults() { return kPunctureFaults; }

Result<PunctureWays> plan_puncture(const Case& the_case, const std::string& scope,
                                   const ScopeOptics& optics, const Skill& skill,
                                   const PunctureEnd& end) {
  const Case begun = as_it_begins(the_case);
  const auto at = puncture_of(the_case, begun, skill);
  if (!at) return tl::unexpected(at.error());
  Random random(skill.seed * 31 + 11);
  const double miss_m = std::min(0.08 * skill.detour_m, 0.004);
  const auto missed = [&](const PortalFrame& frame, const Vec3& fault_W) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    return Vec3(miss_m * (std::cos(angle) * frame.up_W + std::sin(angle) * frame.middle_W) +
                fault_W);
  };
  Vec3 al_off = Vec3::Zero(), am_off = Vec3::Zero();
  if (at->fault == "al_low") al_off = -kWrong_m * at->al.up_W;
  if (at->fault == "al_midline") al_off = kWrong_m * at->al.middle_W;
  if (at->fault == "al_lateral") al_off = -kWrong_m * at->al.middle_W;
  if (at->fault == "am_medial") am_off = -kWrong_m * at->am.middle_W;
  const auto al = skin_way(*at, at->al, missed(at->al, al_off));
  if (!al) return tl::unexpected(al.error());
  const auto am = skin_way(*at, at->am, missed(at->am, am_off));
  if (!am) return tl::unexpected(am.error());
  const auto gaze = looks_across(*at, *al, am->p_W + kLookDeep_m * am->in_W, optics);
  if (!gaze)
    return fail("the scope cannot see the place of the other portal", the_case.name,
                "Use another patient");
  HandWay worker(end.held, puncture_wait(at->am), at->pace);
  make_portal(*at, *al, at->fault, worker);
  worker.go(puncture_wait(at->am), kHandCarry_m_per_s);
  HandWay eye(scope, puncture_wait(at->al), at->pace);
  eye.stay(worker.now_s() + 0.3);
  bring_scope(*al, *gaze, eye);
  eye.stay(kLooked_s);
  if (at->fault == "am_blind") draw_scope_out(*at, *al, eye);
  worker.stay(eye.now_s() + 0.3 - worker.now_s());
  push_needle(*am, worker);
  make_portal(*at, *am, {}, worker);
  if (end.leaves)
    worker.go(puncture_wait(at->am), kHandCarry_m_per_s);
  else
    end_hooked(*at, *am, worker);
  eye.stay(worker.now_s() - eye.now_s());
  std::vector<std::string> unseen;
  const bool is_in = at->fault != "am_blind";
  if (is_in && !end.looks_at.empty()) {
    const OpenSight sight(at->knee, the_case, begun_bones(the_case));
    look_at_marks(*at, end.looks_at, *al, optics, sight, eye, unseen);
  }
  std::vector<std::string> unfelt;
  if (end.leaves && !end.feels.empty()) {
    // While the scope still looks there.
    worker.take("hook_probe");
    worker.stay(eye.now_s() - kLooked_s - worker.now_s());
    feel_soft_marks(*at, end.feels, *am, worker, unfelt);
    worker.go(puncture_wait(at->am), kHandCarry_m_per_s);
    eye.stay(worker.now_s() - eye.now_s());
  }
  if (end.leaves && is_in) draw_scope_out(*at, *al, eye);
  const Pose X_rest = at->X_moved.inverse();
  return PunctureWays{trembling(eye.path(), skill.tremor_m, skill.seed + 6),
                      trembling(worker.path(), skill.tremor_m, skill.seed + 7),
                      X_rest * al->p_W,
                      X_rest * am->p_W,
                      std::move(unseen),
                      std::move(unfelt)};
}

}  // namespace osteon
