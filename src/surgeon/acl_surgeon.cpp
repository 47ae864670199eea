#include "osteon/surgeon/acl_surgeon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "acl_drilling.h"
#include "acl_knee.h"
#include "acl_lines.h"
#include "acl_way.h"
#include "clearing_view.h"
#include "osteon/base/random.h"
#include "osteon/mesh/distance.h"
#include "osteon/scene/stumps.h"
#include "osteon/surgeon/graft_surgeon.h"
#include "osteon/surgeon/scope_reach.h"
#include "stump_way.h"

namespace osteon {
namespace {

constexpr double kOutside_m = 0.05;  // before the skin
constexpr double kAway_m = 0.35;     // where an instrument stands in nobody's way
constexpr double kPinAway_m = 0.1;
constexpr double kAir_m_per_s = 0.25;
constexpr double kTravel_m_per_s = 0.04;  // through the joint
constexpr double kLook_s = 1.4, kTurn_s = 1.5;
constexpr double kGrip_n_per_m = 500, kYields_m = 0.0012;  // of the hand, and of what it presses
constexpr double kPress_s = 0.6;
constexpr double kPinDeep_m = 0.0025, kPin_s = 1.8;  // how a pin is pressed on, and for how long
constexpr double kTooHard_m = 0.012;
constexpr double kShaverRadius_m = 0.0021;  // of the usual size
// A shaver at full power sucks off more than the usual 60 mmHg bring in.
constexpr double kShavingPump_pa = 100 * 133.322;

constexpr std::array<std::string_view, 31> kFaults{"wrong_portal",
                                                   "skipped_inspection",
                                                   "scuffed",
                                                   "too_hard",
                                                   "anterior_tibia",
                                                   "short_tibia",
                                                   "vertical_femur",
                                                   "blow_out",
                                                   "no_pin",
                                                   "plunged",
                                                   "short_socket",
                                                   "lost_thread",
                                                   "unflipped_button",
                                                   "soft_tissue",
                                                   "flipped_in_muscle",
                                                   "few_cycles",
                                                   "slack_tension",
                                                   "diverging_screw",
                                                   "shallow_screw",
                                                   "stump_left",
                                                   "cleared_blind",
                                                   "sound_part_cut",
                                                   "not_examined",
                                                   "fault_missed",
                                                   "sound_blamed",
                                                   "sound_socket_drilled",
                                                   "sound_tunnel_drilled",
                                                   "misplaced_socket",
                                                   "misplaced_tunnel",
                                                   "into_old_socket",
                                                   "into_old_tunnel"};

// Those that can be made in one bone alone.
constexpr std::array<std::string_view, 5> kTibialFaults{"no_pin", "plunged", "sound_tunnel_drilled",
                                                        "misplaced_tunnel", "into_old_tunnel"};
constexpr std::array<std::string_view, 4> kFemoralFaults{"short_socket", "sound_socket_drilled",
                                                         "misplaced_socket", "into_old_socket"};

// How somebody does it.
struct AclHabits {
  std::string fault;
  double pace = 1, press_m = 0.003;
  Vec3 femur_miss_W = Vec3::Zero(), tibia_miss_W = Vec3::Zero();
};

// An expert leads no way astray: his detour is none, and he misses nothing.
AclHabits habits_of(const Skill& skill) {
  AclHabits habits;
  if (skill.name.starts_with("bad:")) habits.fault = skill.name.substr(4);
  habits.pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  habits.press_m = kYields_m + skill.press_n / kGrip_n_per_m;
  Random random(skill.seed * 31 + 7);
  const double miss_m = 0.1 * skill.detour_m;
  habits.femur_miss_W = miss_m * random.direction();
  habits.tibia_miss_W = miss_m * random.direction();
  return habits;
}

// Through which portal each of both goes in.
struct ScopePortals {
  Vec3 scope_W = Vec3::Zero(), probe_W = Vec3::Zero();
};

Vec3 outwards(const AclKnee& knee, const Vec3& portal_W) {
  const Vec3 middle = 0.5 * (knee.mark("acl_femur") + knee.mark("acl_tibia"));
  return (portal_W - middle).normalized();
}

// With some room about the line of sight, and by the rule's own measure, a little stricter: a bump
// of the bone right before the mark hides it.
bool shows(const AclKnee& knee, const Vec3& eye_W, const Vec3& mark_W) {
  constexpr double kSpare_m = 0.0006;
  const Vec3 back = (eye_W - mark_W).normalized();
  return knee.is_free(eye_W, mark_W + 0.0025 * back, 0.0004) &&
         !is_hidden(knee.whole(), rest_snapshot(knee.whole()), eye_W, mark_W, kSpare_m);
}

// Whether the mark is near enough to the middle of the picture, and neither too near nor too far.
bool well_seen(const AclTools& tools, const Pose& X_WT, const Vec3& mark_W) {
  constexpr double kCentral = 0.4, kClosest_m = 0.005, kFarthest_m = 0.028;
  const ScopeView view = view_through(tools.optics, X_WT);
  const Vec3 way = mark_W - view.eye_W;
  const double cosine = way.normalized().dot(view.along_W);
  return way.norm() > kClosest_m && way.norm() < kFarthest_m &&
         cosine > std::cos(kCentral * tools.optics.half_field_rad);
}

// From near what is usual outwards, upright first.
std::optional<Gaze> gaze_over(const AclKnee& knee, const AclTools& tools, const Vec3& portal_W,
                              const Vec3& mark_W, const Vec3& aim_W) {
  constexpr double kScopeRadius_m = 0.0025;
  for (int turn = 0; turn <= 11; ++turn)
    for (const double side : {1.0, -1.0})
      for (const double mm : {14.0, 18.0, 11.0, 22.0, 26.0, 8.0}) {
        const Gaze gaze{aim_W, 0.001 * mm, side * turn * 15 * kAclTurn};
        const auto pose = pose_for(gaze, portal_W, tools.optics);
        if (pose && well_seen(tools, *pose, mark_W) &&
            knee.is_free(pose->p, portal_W, kScopeRadius_m) && shows(knee, pose->p, mark_W))
          return gaze;
      }
  return std::nullopt;
}

// At the mark itself; where a bone is in the way of that, a little beside it.
std::optional<Gaze> gaze_at(const AclKnee& knee, const AclTools& tools, const Vec3& portal_W,
                            const Vec3& mark_W) {
  if (auto gaze = gaze_over(knee, tools, portal_W, mark_W, mark_W)) return gaze;
  for (const double beside_m : {0.004, 0.007})
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1.0, -1.0}) {
        const Vec3 aim_W = mark_W + side * beside_m * Vec3::Unit(axis);
        if (auto gaze = gaze_over(knee, tools, portal_W, mark_W, aim_W)) return gaze;
      }
  return std::nullopt;
}

Gaze between(const Gaze& a, const Gaze& b, double f) {
  return {a.at_W + f * (b.at_W - a.at_W), a.distance_m + f * (b.distance_m - a.distance_m),
          a.turn_rad + f * (b.turn_rad - a.turn_rad)};
}

// Drawn back from the bone meanwhile.
void look_over(AclWay& way, const Gaze& from, const Gaze& to, const Vec3& portal_W,
               const ScopeOptics& optics) {
  constexpr int kSteps = 24;
  constexpr double kBack_m = 0.015;
  for (int k = 1; k <= kSteps; ++k) {
    const double f = static_cast<double>(k) / kSteps;
    auto pose = pose_for(between(from, to, f * f * (3 - 2 * f)), portal_W, optics);
    if (!pose) continue;
    pose->p += kBack_m * std::min({1.0, 4 * f, 4 * (1 - f)}) * pose->rotate(Vec3::UnitZ());
    way.go(*pose, kTurn_s / kSteps);
  }
}

// On into the bone that it looks at, and back.
void push_on(const AclKnee& knee, AclWay& way, const Vec3& at_W) {
  const Pose held = way.pose();
  way.go({at_W - kTooHard_m * knee.normal(true, at_W), held.q}, 1.5);
  way.stay(kPress_s);
  way.go(held, 1.5);
}

// Out through the portal, and to the outer side of the leg: before the knee a shank that is
// stretched out would strike it, in the joint both bones would press it.
void leave(const AclKnee& knee, AclWay& way, const Vec3& portal_W) {
  const Vec3 back = way.pose().rotate(Vec3::UnitZ()), outer = knee.femoral(-Vec3::UnitY());
  way.go_at({portal_W + kOutside_m * back, way.pose().q}, kTravel_m_per_s);
  way.go_at({portal_W + kAway_m * back, way.pose().q}, kAir_m_per_s);
  way.go_at(held_by_shaft(portal_W + kAway_m * outer, outer), kAir_m_per_s);
}

// From outside through the portal to where it looks.
void enter(AclWay& way, const Pose& to, const Vec3& portal_W) {
  way.go_at({portal_W + kOutside_m * to.rotate(Vec3::UnitZ()), to.q}, kAir_m_per_s);
  way.go_at(to, kTravel_m_per_s);
}

// Through the portal, from mark to mark over it, and out again: in a joint that is bent a scope
// would be pressed.
AclWay scope_way(const AclKnee& knee, const AclTools& tools, const Vec3& portal_W,
                 const AclHabits& habits, std::vector<std::string>& unreachable) {
  std::vector<Gaze> gazes;
  for (const std::string& name : tools.tour) {
    const auto gaze = gaze_at(knee, tools, portal_W, knee.mark(name));
    if (gaze)
      gazes.push_back(*gaze);
    else
      unreachable.push_back(name);
  }
  const Vec3 out = outwards(knee, portal_W);
  AclWay way(tools.scope, 0, held_by_shaft(portal_W + kAway_m * out, out), habits.pace);
  way.wait_until(tools.begin_s + 0.1);
  if (gazes.empty() || habits.fault == "skipped_inspection") return way;
  enter(way, *pose_for(gazes[0], portal_W, tools.optics), portal_W);
  for (std::size_t i = 0; i < gazes.size(); ++i) {
    if (i > 0) look_over(way, gazes[i - 1], gazes[i], portal_W, tools.optics);
    way.stay(kLook_s);
  }
  if (habits.fault == "scuffed") push_on(knee, way, gazes.back().at_W);
  leave(knee, way, portal_W);
  return way;
}

// Where a rod that comes straight through the portal gets to the bone: at the mark, or where an
// edge of the notch is before that, as near beside it as can be.
std::optional<Vec3> reached_from(const AclKnee& knee, const StumpsAsObstacles* stumps,
                                 const Vec3& portal_W, const Vec3& mark_W, double radius_m) {
  constexpr double kBefore_m = 0.006, kPast_m = 0.012;
  constexpr int kRound = 16;
  const auto free = [&](const Vec3& p_W) {
    const Vec3 back = (portal_W - p_W).normalized();
    return knee.is_free(p_W + kBefore_m * back, portal_W, radius_m) &&
           (!stumps || stumps->is_free(p_W, p_W + kPast_m * back, radius_m));
  };
  if (free(mark_W)) return mark_W;
  const Vec3 up = knee.normal(true, mark_W), x = up.unitOrthogonal(), y = up.cross(x);
  for (const double beside_m : {0.0015, 0.003, 0.0045, 0.006})
    for (int k = 0; k < kRound; ++k) {
      const double angle = 2 * std::numbers::pi * k / kRound;
      const Vec3 p_W =
          knee.on_femur(mark_W + beside_m * (std::cos(angle) * x + std::sin(angle) * y));
      if (free(p_W)) return p_W;
    }
  return std::nullopt;
}

// Straight through the portal onto each mark. Stumps would draw the hook aside: a mark that no way
// beside them leads to waits. Returns those that do; without `stumps` none does.
std::vector<std::string> feel_marks(const AclKnee& knee, const std::vector<std::string>& marks,
                                    const StumpsAsObstacles* stumps, const Vec3& portal_W,
                                    const AclHabits& habits, AclWay& way,
                                    std::vector<std::string>& unreachable) {
  constexpr double kProbeRadius_m = 0.0015, kBefore_m = 0.008;
  std::vector<std::string> waiting;
  const double press_m = habits.fault == "too_hard" ? kTooHard_m : habits.press_m;
  for (const std::string& name : marks) {
    const auto reached = reached_from(knee, stumps, portal_W, knee.mark(name), kProbeRadius_m);
    if (!reached) {
      (stumps ? waiting : unreachable).push_back(name);
      continue;
    }
    const Vec3& mark = *reached;
    const Vec3 back = (portal_W - mark).normalized();
    way.go_at(held_by_shaft(portal_W + kOutside_m * back, back), kAir_m_per_s);
    way.go_at(held_by_shaft(mark + kBefore_m * back, back), kTravel_m_per_s);
    const Vec3 on = habits.fault == "too_hard" ? Vec3(-knee.normal(true, mark)) : Vec3(-back);
    way.go(held_by_shaft(mark + press_m * on, back), 0.8);
    way.stay(kPress_s);
    way.go(held_by_shaft(mark + kBefore_m * back, back), 0.5);
    way.go_at(held_by_shaft(portal_W + kOutside_m * back, back), kTravel_m_per_s);
  }
  return waiting;
}

// What is to be cleared, and how somebody looks on.
struct Clearing {
  StumpClearing with;
  double before_m = 0;
  std::vector<ClearingView> views;  // empty: nobody looks
  std::vector<ClearingPlace> places;
};

// Deepest in the other cruciate ligament of the places that a shaver gets to without touching bone.
std::optional<ClearingPlace> place_in_pcl(const AclKnee& knee, const StumpClearing& with) {
  constexpr std::size_t kStride = 5;
  constexpr double kIn_m = 0.0025;
  const Case& whole = knee.whole();
  const auto pcl = std::find_if(whole.softs.begin(), whole.softs.end(),
                                [](const SoftPart& part) { return part.name == "pcl"; });
  if (pcl == whole.softs.end()) return std::nullopt;
  const MeshDistance surface(pcl->mesh_W);
  std::optional<ClearingPlace> best;
  double deepest_m = 0;
  for (std::size_t v = 0; v < pcl->mesh_W.vertices.size(); v += kStride) {
    const Vec3& on_W = pcl->mesh_W.vertices[v];
    const Vec3 in_W = on_W + kIn_m * (on_W - with.portal_W).normalized();
    const double deep_m = -surface.closest(in_W).signed_distance;
    if (deep_m <= deepest_m || !knee.is_free(in_W, with.portal_W, with.radius_m)) continue;
    deepest_m = deep_m;
    best = ClearingPlace{in_W, 0, Vec3::Zero()};
  }
  return best;
}

// Who leaves a stump leaves the one on the tibia: on the femur it would push the aimer aside.
Clearing plan_clearing(const AclKnee& knee, const AclTools& tools, const AclHabits& habits,
                       const ScopePortals& portals) {
  std::vector<TornStump> stumps = torn_stumps(knee.whole());
  const StumpsAsObstacles all(knee.whole(), stumps);
  if (habits.fault == "stump_left") {
    const BoneId tibia = knee.whole().find("tibia");
    std::erase_if(stumps, [&](const TornStump& stump) { return stump.bone == tibia; });
  }
  Clearing out{{tools.shaver, 0, kShaverRadius_m, portals.probe_W}, 0, {}, {}};
  out.before_m = before_stumps_m(knee, stumps, portals.probe_W);
  out.places = clearing_places(knee, stumps, out.with);
  if (habits.fault == "sound_part_cut")
    if (const auto place = place_in_pcl(knee, out.with)) out.places.push_back(*place);
  if (habits.fault == "cleared_blind" || habits.fault == "skipped_inspection") return out;
  ClearingWatcher who{tools.optics, portals.scope_W, {}, {}};
  for (const std::string& name : tools.felt) who.also_W.push_back(knee.mark(name));
  for (const char* name : {"acl_femur", "acl_tibia"}) who.aims_W.push_back(knee.mark(name));
  out.views = clearing_views(knee, all, out.with, who, out.places);
  return out;
}

// With the shaver, and out again. The scope looks on, and turns to what comes next before it is
// cleared.
void clear(const Clearing& plan, const ScopePortals& portals, const ScopeOptics& optics,
           AclWay& scope, AclWay& way) {
  if (plan.places.empty()) return;
  const auto& first = plan.views.empty() ? plan.places : plan.views.front().places;
  begin_clearing(plan.with, first.front(), plan.before_m, way);
  if (plan.views.empty()) {
    clear_places(plan.with, plan.places, plan.before_m, way);
    return end_clearing(plan.with, plan.places.back(), way);
  }
  for (std::size_t v = 0; v < plan.views.size(); ++v) {
    if (v > 0) {
      scope.wait_until(way.now_s());
      look_over(scope, plan.views[v - 1].gaze, plan.views[v].gaze, portals.scope_W, optics);
      way.wait_until(scope.now_s());
    }
    clear_places(plan.with, plan.views[v].places, plan.before_m, way);
  }
  end_clearing(plan.with, plan.views.back().places.back(), way);
}

// Comes along its axis, is pressed on straight into the bone, and goes back.
void set_pin(const AclKnee& knee, bool of_femur, const AclLine& line, AclWay& way) {
  const Vec3 back = -line.in_W, up = knee.normal(of_femur, line.at_W);
  const auto before = [&](double m) { return held_by_shaft(line.at_W + m * back, back); };
  way.go_at(before(kPinAway_m), kAir_m_per_s);
  way.go_at(before(0.004), kTravel_m_per_s);
  way.go(held_by_shaft(line.at_W - kPinDeep_m * up, back), 0.8);
  way.stay(kPin_s);
  way.go(before(0.004), 0.5);
  way.go_at(before(kPinAway_m), kTravel_m_per_s);
}

AclWay pin_way(const AclKnee& knee, const AclTools& tools, const AclLine& tibia,
               const AclLine& femur, double begin_s, double pace) {
  AclWay way(tools.pin, 0, held_by_shaft(tibia.at_W - kPinAway_m * tibia.in_W, -tibia.in_W), pace);
  way.wait_until(begin_s);
  set_pin(knee, false, tibia, way);
  set_pin(knee, true, femur, way);
  way.stay(1);
  return way;
}

Result<void> check_marks(const AclKnee& knee, const AclTools& tools, const AclHabits& habits) {
  for (const auto* marks : {&tools.tour, &tools.felt})
    for (const std::string& name : *marks)
      if (!knee.has_mark(name)) return fail("the case has no landmark '" + name + "'", "tour");
  const auto is_among = [&](std::span<const std::string_view> faults) {
    return std::find(faults.begin(), faults.end(), habits.fault) != faults.end();
  };
  // Those of making a graft are another hand's in the same operation.
  if (!habits.fault.empty() && !is_among(kFaults) && !is_among(graft_faults_in_knee()))
    return fail("no virtual surgeon can make the error '" + habits.fault + "'", "surgeon");
  if ((is_among(kTibialFaults) && !tools.drills_tibia) ||
      (is_among(kFemoralFaults) && !tools.drills_femur))
    return fail("this patient gives no occasion for the error '" + habits.fault + "'", "surgeon",
                "Choose another --seed");
  return {};
}

// Both tunnels, as far as they are to be drilled.
Result<AclDrillPlan> plan_drilling(const AclKnee& knee, const AclTools& tools,
                                   const AclHabits& habits) {
  AclDrillPlan plan;
  plan.reamed_m = tools.reamed_m;
  plan.socket_m = tools.socket_m;
  plan.drills_tibia = tools.drills_tibia;
  plan.drills_femur = tools.drills_femur;
  if (plan.drills_tibia) {
    const auto tibia = tibial_line(knee, habits.fault, habits.tibia_miss_W, tools.reamed_m);
    if (!tibia) return tl::unexpected(tibia.error());
    plan.tibia = *tibia;
  }
  if (plan.drills_femur) {
    const auto femur = femoral_line(knee, habits.fault, habits.femur_miss_W, tools.reamed_m);
    if (!femur) return tl::unexpected(femur.error());
    plan.femur = *femur;
  }
  return plan;
}

// The probe's hand, from when the knee is bent again; the scope looks on where stumps are cleared.
AclWay probe_way(const AclKnee& knee, const AclTools& tools, const ScopePortals& portals,
                 const AclHabits& habits, double begin_s, AclWay& scope, AclWays& ways) {
  // Before the anterolateral portal the shank would come by as the knee is examined.
  const bool swapped = habits.fault == "wrong_portal";
  const Vec3& portal_W = portals.probe_W;
  const Vec3 out = swapped ? knee.femoral(-Vec3::UnitY()) : outwards(knee, portal_W);
  const Pose aside = held_by_shaft(portal_W + kAway_m * out, out);
  AclWay probe(tools.probe, 0, aside, habits.pace);
  probe.wait_until(begin_s);
  const StumpsAsObstacles stumps(knee.whole(), torn_stumps(knee.whole()));
  const bool clears = !tools.shaver.empty();
  const Clearing clearing = clears ? plan_clearing(knee, tools, habits, portals) : Clearing();
  const bool watched = !clearing.views.empty();
  if (watched) {
    scope.wait_until(begin_s);
    enter(scope, *pose_for(clearing.views[0].gaze, portals.scope_W, tools.optics), portals.scope_W);
    probe.wait_until(scope.now_s());
  }
  const auto waiting =
      feel_marks(knee, tools.felt, &stumps, portal_W, habits, probe, ways.unreachable);
  probe.go_at(aside, kAir_m_per_s);
  if (watched) ways.exam.push_back({probe.now_s(), {CommandKind::kPump, kShavingPump_pa}});
  if (clears) clear(clearing, portals, tools.optics, scope, probe);
  if (clears) probe.go_at(aside, kAir_m_per_s);
  if (!waiting.empty()) {
    if (clears) probe.take(tools.probe, 0);
    feel_marks(knee, waiting, nullptr, portal_W, habits, probe, ways.unreachable);
    probe.go_at(aside, kAir_m_per_s);
  }
  if (watched) {
    scope.wait_until(probe.now_s());
    leave(knee, scope, portals.scope_W);
    probe.wait_until(scope.now_s());
  }
  return probe;
}

}  // namespace

std::span<const std::string_view> acl_faults() { return kFaults; }

Result<AclWays> plan_acl(const Case& the_case, const AclTools& tools, const Skill& skill) {
  auto knee = AclKnee::make(the_case);
  if (!knee) return tl::unexpected(knee.error());
  if (tools.spares_softs) knee->spare_softs();
  const AclHabits habits = habits_of(skill);
  if (auto ok = check_marks(*knee, tools, habits); !ok) return tl::unexpected(ok.error());
  const auto plan = plan_drilling(*knee, tools, habits);
  if (!plan) return tl::unexpected(plan.error());
  const bool swapped = habits.fault == "wrong_portal";
  ScopePortals portals{tools.al_W.value_or(knee->mark("portal_al")),
                       tools.am_W.value_or(knee->mark("portal_am"))};
  if (swapped) std::swap(portals.scope_W, portals.probe_W);
  AclWays ways;
  AclWay scope = scope_way(*knee, tools, portals.scope_W, habits, ways.unreachable);
  double probe_s = scope.now_s() + 0.5;
  ways.examines = tools.drills && tools.examines && habits.fault != "not_examined";
  if (ways.examines) {
    const double at_deg = the_case.joints.empty() ? 0 : the_case.joints.front().at_deg;
    KneeExamOrders exam = plan_knee_exam(probe_s, at_deg, at_deg);
    probe_s = exam.end_s;
    ways.exam = std::move(exam.orders);
  }
  const AclWay probe = probe_way(*knee, tools, portals, habits, probe_s, scope, ways);
  ways.third_begin_s = probe.now_s() + 0.5;
  ways.after_graft = tools.drills && tools.after_graft;
  if (tools.drills)
    ways.drilling = drill_both(
        *knee, *plan, habits.fault,
        ways.after_graft || !ways.exam.empty() || tools.begin_s > 0 ? 0 : ways.third_begin_s,
        habits.pace);
  ways.scope = trembling(scope.path(), skill.tremor_m, skill.seed);
  ways.probe = trembling(probe.path(), skill.tremor_m, skill.seed + 1);
  if (tools.drills) return ways;
  const AclWay pin =
      pin_way(*knee, tools, plan->tibia, plan->femur, ways.third_begin_s, habits.pace);
  ways.pin = trembling(pin.path(), skill.tremor_m, skill.seed + 2);
  return ways;
}

}  // namespace osteon
