#include "commands/teaching/reconstruction_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "commands/teaching/opened_knee.h"
#include "commands/teaching/played_hand.h"
#include "exercises/graft_order.h"
#include "exercises/skin_order.h"
#include "osteon/physics/skin_setup.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/scene/tool_set.h"
#include "osteon/surgeon/acl_surgeon.h"
#include "osteon/surgeon/exam_surgeon.h"
#include "osteon/surgeon/graft_surgeon.h"
#include "osteon/surgeon/parts_hand.h"
#include "osteon/surgeon/placing_surgeon.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

bool has_goal(const ScenarioPlan& plan, std::string_view kind) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.rule.kind == kind) return true;
  return false;
}

// Whoever makes an error before the graft comes stops where it was made: his run is lost already.
bool errs_before_the_graft(const Skill& skill) {
  constexpr std::array<std::string_view, 14> kBefore{
      "wrong_portal", "skipped_inspection", "scuffed",      "too_hard",      "anterior_tibia",
      "short_tibia",  "vertical_femur",     "blow_out",     "no_pin",        "plunged",
      "short_socket", "stump_left",         "not_examined", "sound_part_cut"};
  return skill.name.starts_with("bad:") &&
         std::find(kBefore.begin(), kBefore.end(), skill.name.substr(4)) != kBefore.end();
}

// The same of who makes it.
bool errs_with_the_graft(const Skill& skill) {
  const auto faults = graft_faults_in_knee();
  return skill.name.starts_with("bad:") &&
         std::find(faults.begin(), faults.end(), skill.name.substr(4)) != faults.end();
}

// Of the screws that a hand may take the one that is nearest to 1 mm wider than the tunnel; empty:
// there is none.
std::string screw_of(const PlannedHand& hand, double tunnel_m) {
  std::string best;
  double least = 1;
  for (const std::string& name : hand.also) {
    const auto tool = parse_tool_name(name);
    if (!tool || tool->name != "interference_screw" || !tool->size_mm) continue;
    const double off_m = std::abs(1e-3 * *tool->size_mm - tunnel_m - 0.001);
    if (off_m > least - 1e-6 && !best.empty()) continue;
    best = name;
    least = off_m;
  }
  return best;
}

// The narrowest drill of the exercise for a tunnel.
constexpr double kLeastDrill_m = 0.008;
constexpr double kShallowSocket_m = 0.0215;

// A graft that is made is hung on its button when the tunnels are measured, placed when it has
// come, fixed when its button has turned, and the knee examined once it is known how it gives then.
std::vector<PartsHand::Plan> later_parts(const ScenarioPlan& plan, const PlannedHand& hand,
                                         const Case& the_case, const Skill& skill,
                                         const LaterWork& work) {
  std::vector<PartsHand::Plan> parts;
  if (!has_goal(plan, "button_turned") || errs_before_the_graft(skill)) return parts;
  if (work.made)
    parts.push_back([&the_case, &skill, work, held = hand.instrument](const Pose& from) {
      const auto room = work.room();
      std::optional<HandPart> part;
      if (!room) return part;
      auto way = plan_loop_stage(the_case, skill, room->channel_m, room->socket_m, from, held);
      if (way) part = HandPart{std::move(*way), {}};
      return part;
    });
  if (errs_with_the_graft(skill)) return parts;
  parts.push_back([&the_case, &skill, work, held = hand.instrument](const Pose& from) {
    const BoneSnapshot* now = work.bones();
    std::optional<HandPart> part;
    if (now && now->placing.on)
      part = HandPart{plan_graft_placing(the_case, now->placing.plan, skill, from, held), {}};
    return part;
  });
  if (!has_goal(plan, "screw_in") || screw_of(hand, 0.008).empty()) return parts;
  parts.push_back([&the_case, &skill, &hand, work](const Pose& from) {
    const BoneSnapshot* now = work.bones();
    std::optional<HandPart> part;
    if (!now || now->placing.phase != PlacingPhase::kTurned) return part;
    const std::string screw = screw_of(hand, 2 * now->placing.plan.tibia.radius_m);
    auto way = plan_graft_fixing(the_case, now->placing.plan, skill, from, "clamp", screw);
    if (way) part = std::move(*way);
    return part;
  });
  if (!has_goal(plan, "knee_examined")) return parts;
  parts.push_back([work](const Pose& from) {
    const BoneSnapshot* now = work.bones();
    std::optional<HandPart> part;
    if (now && now->exam.on && now->exam.knee == 1)
      part = plan_exam_part("clamp", from, now->bend.now_deg, now->bend.now_deg);
    return part;
  });
  return parts;
}

// Stays where it will begin, while the knee is asked for something.
HandPart waiting_part(const std::string& held, const Pose& at, double until_s,
                      std::vector<TimedCommand> orders) {
  ProbePath path;
  path.with_instruments = true;
  for (const double time_s : {0.0, until_s}) {
    path.samples.emplace_back(time_s, at, false);
    path.samples.back().instrument = held;
  }
  return {std::move(path), std::move(orders)};
}

// Where an incision is made; none: nobody makes one.
std::optional<Pose> site_of_incision(const ScenarioPlan& plan, const Case& the_case) {
  if (!has_goal(plan, "skin_opened")) return std::nullopt;
  for (const std::string& name : plan.scenario.soft) {
    if (!is_skin_elsewhere(name)) continue;
    if (const auto X_WS = patch_frame(the_case, name, {anatomical_frame(the_case).distal_W}))
      return *X_WS;
  }
  return std::nullopt;
}

// Without what he gave away nothing is drilled.
bool ends_at_the_bench(const Skill& skill) {
  constexpr std::array<std::string_view, 3> kEnds{"amputated_tendon", "incision_aside",
                                                  "incision_deep"};
  return skill.name.starts_with("bad:") &&
         std::find(kEnds.begin(), kEnds.end(), skill.name.substr(4)) != kEnds.end();
}

// The third hand: a graft as far as it is made before the tunnels, then those and the rest.
struct ThirdHand {
  std::vector<std::unique_ptr<HandPlayer>> first;
  AclDriller* driller = nullptr;  ///< null: he does not come to drill
  ScriptedHand* maker = nullptr;  ///< null: he makes no graft
};
Result<ThirdHand> plan_third_hand(const Case& the_case, const PlannedHand& hand, const Skill& skill,
                                  const std::optional<Pose>& X_WSite, AclWays& ways) {
  ThirdHand out;
  auto drills = std::make_unique<AclDriller>(std::move(ways.drilling), skill);
  if (ways.after_graft) {
    auto way = plan_graft_stage(the_case, skill, ways.third_begin_s, drills->start(),
                                hand.instrument, X_WSite);
    if (!way) return tl::unexpected(way.error());
    auto maker = std::make_unique<ScriptedHand>(HandPart{std::move(*way), std::move(ways.exam)});
    out.maker = maker.get();
    out.first.push_back(std::move(maker));
    if (ends_at_the_bench(skill)) return out;
  }
  if (!ways.after_graft && !ways.exam.empty())
    out.first.push_back(std::make_unique<ScriptedHand>(
        waiting_part(hand.instrument, drills->start(), ways.third_begin_s, std::move(ways.exam))));
  out.driller = drills.get();
  out.first.push_back(std::move(drills));
  return out;
}

// Of tunnels that were there before, those that are sound stay, but with who takes them for faulty.
void choose_bones(const ScenarioPlan& plan, const Skill& skill, AclTools& tools) {
  const auto is_left = [&](std::string_view kind) {
    for (const auto& goals : plan.goals)
      for (const PlannedRule& goal : goals)
        if (goal.rule.kind == kind) return !goal.applies;
    return false;
  };
  tools.drills_femur = !is_left("socket_drilled");
  tools.drills_tibia = !is_left("tunnel_drilled");
  const std::string& who = skill.name;
  const bool blames_socket = who == "bad:sound_socket_drilled";
  const bool blames_tunnel = who == "bad:sound_tunnel_drilled";
  if (who != "bad:fault_missed" && !blames_socket && !blames_tunnel) return;
  tools.drills_femur = blames_socket && !tools.drills_femur;
  tools.drills_tibia = blames_tunnel && !tools.drills_tibia;
}

Result<AclTools> tools_of(const ScenarioRun& run, const ScenarioPlan& plan, const Case& the_case,
                          std::span<const PlannedHand> hands) {
  AclTools tools;
  for (const PlannedHand& hand : hands) {
    if (hand.pin) {
      tools.pin = hand.instrument;
      tools.drills = !hand.also.empty();
    } else if (hand.optics) {
      tools.scope = hand.instrument;
      tools.optics = *hand.optics;
    } else {
      tools.probe = hand.instrument;
      for (const std::string& name : hand.also)
        if (has_goal(plan, "stumps_cleared") && name.starts_with("shaver")) tools.shaver = name;
    }
  }
  if (tools.pin.empty() || tools.scope.empty())
    return fail("needs a hand with a scope and one with a guide pin", run.scenario.where);
  tools.examines = has_goal(plan, "knee_examined");
  const auto& soft = run.scenario.soft;
  tools.spares_softs = std::find(soft.begin(), soft.end(), "menisci") != soft.end();
  choose_bones(plan, run.skill, tools);
  // What comes before is a part of making the portals.
  const auto bent = stage_bent_after_portals(plan);
  for (std::size_t s = bent ? *bent + 1 : 0; s < plan.goals.size(); ++s)
    for (const PlannedRule& goal : plan.goals[s]) {
      const auto& marks = goal.rule.marks;
      if (goal.rule.kind == "seen") tools.tour.insert(tools.tour.end(), marks.begin(), marks.end());
      if (goal.rule.kind == "felt") tools.felt.insert(tools.felt.end(), marks.begin(), marks.end());
    }
  if (!run.graft_json.empty()) {
    const auto graft = made_graft(run.graft_json, "--graft");
    if (!graft) return tl::unexpected(graft.error());
    tools.reamed_m = std::max(kLeastDrill_m, sizer_for(graft->diameter_m));
  }
  if (!has_goal(plan, "loop_hung") || errs_before_the_graft(run.skill)) return tools;
  const auto drilled_m = drilled_for_graft(the_case, run.skill);
  if (!drilled_m) return tl::unexpected(drilled_m.error());
  tools.reamed_m = *drilled_m;
  // The shortest loop that there is would fit most sockets of the usual depth.
  if (run.skill.name == "bad:short_loop") tools.socket_m = kShallowSocket_m;
  tools.after_graft = true;
  return tools;
}

// In a live run tunnels and the knee are measured on another thread, meanwhile the hand waits.
constexpr double kLivePatience_s = 120;

// Whoever makes an error with the portals goes no farther; the third hand waits beside the knee.
void open_alone(OpenedKnee& opened, const Case& the_case, std::span<const PlannedHand> hands,
                HeadlessRun& headless) {
  constexpr double kBeside_m = 0.4;
  const Pose beside{the_case.bounds_W().center() + kBeside_m * Vec3::UnitZ(), Quat::Identity()};
  for (const PlannedHand& hand : hands) {
    ProbePath way = hand.pin      ? waiting_part(hand.instrument, beside, opened.end_s, {}).path
                    : hand.optics ? std::move(opened.scope)
                                  : std::move(opened.worker);
    headless.hands.push_back({hand.name, std::move(way)});
  }
}

}  // namespace

// The ways up to the tunnels are known before it begins.
Result<std::vector<std::string>> plan_reconstruction(
    const ScenarioRun& run, const ScenarioPlan& plan, const Case& the_case,
    std::span<const PlannedHand> hands, LaterWork work, HeadlessRun& headless,
    std::vector<std::unique_ptr<HandPlayer>>& players) {
  auto tools = tools_of(run, plan, the_case, hands);
  if (!tools) return tl::unexpected(tools.error());
  auto opened = plan_opening(plan, the_case, run.skill, *tools);
  if (!opened) return tl::unexpected(opened.error());
  if (*opened && (*opened)->erred) {
    open_alone(**opened, the_case, hands, headless);
    return std::vector<std::string>();
  }
  auto ways = plan_acl(the_case, *tools, run.skill);
  if (!ways) return tl::unexpected(ways.error());
  if (*opened) {
    ways->scope = joined(std::move((*opened)->scope), ways->scope);
    ways->probe = joined(std::move((*opened)->worker), ways->probe);
    ways->exam.insert(ways->exam.begin(), (*opened)->orders.begin(), (*opened)->orders.end());
    ways->unreachable.insert(ways->unreachable.end(), (*opened)->unreachable.begin(),
                             (*opened)->unreachable.end());
  }
  work.made = ways->after_graft;
  ThirdHand third;
  PartsHand* whole = nullptr;
  for (const PlannedHand& hand : hands) {
    if (hand.pin && tools->drills) {
      auto planned =
          plan_third_hand(the_case, hand, run.skill, site_of_incision(plan, the_case), *ways);
      if (!planned) return tl::unexpected(planned.error());
      third = std::move(*planned);
      auto parts = third.driller ? later_parts(plan, hand, the_case, run.skill, work)
                                 : std::vector<PartsHand::Plan>();
      auto made = std::make_unique<PartsHand>(std::move(third.first), std::move(parts));
      if (run.live) made->set_patience(kLivePatience_s);
      whole = made.get();
      headless.hands.push_back(played_by(*made, hand, headless.hand));
      players.push_back(std::move(made));
      continue;
    }
    ProbePath& way = hand.pin ? ways->pin : hand.optics ? ways->scope : ways->probe;
    headless.hands.push_back({hand.name, std::move(way)});
  }
  if (!whole) return ways->unreachable;
  const std::vector<std::string> tray = tray_of_hands(headless.hands);
  if (third.driller) third.driller->set_tray(tray);
  if (third.maker) third.maker->set_tray(tray);
  whole->set_tray(tray);
  return ways->unreachable;
}

}  // namespace osteon
