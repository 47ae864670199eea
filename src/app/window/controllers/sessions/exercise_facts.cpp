#include "window/controllers/sessions/exercise_facts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "osteon/physics/graft_placing.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/marks_now.h"
#include "ui/label.h"

namespace osteon {
namespace {

using Facts = std::vector<ExerciseModel::Told>;

constexpr const char* kTendonTitles[kGraftTendons] = {"Semitendinosus", "Gracilis"};

std::string in_mm_to_tenths(double m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", 1e3 * m);
  return text;
}

std::string whole_mm(double m) { return std::to_string(std::lround(1e3 * m)) + " mm"; }

std::string so_far(double m, double of_m) {
  return std::to_string(std::lround(1e3 * m)) + " of " + whole_mm(of_m);
}

std::string counted(std::uint32_t count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

void add_tendon(const std::string& title, const TendonOnBench& tendon, Facts& facts) {
  if (tendon.amputated)
    facts.push_back({title, "cut off", "At a band that the stripper was pushed through"});
  else if (tendon.front_m > 0 && !tendon.stripped)
    facts.push_back({title, whole_mm(tendon.front_m) + " stripped",
                     "How far the stripper has come from the insertion"});
  else if (tendon.stripped && tendon.folds == 0)
    facts.push_back({title, "out, " + whole_mm(tendon.front_m),
                     "Its length; it lies on the table, its free end over its knob"});
  if (tendon.scraped_m > 0)
    facts.push_back({title + ", muscle",
                     std::to_string(std::lround(100 * tendon.muscle_left())) + " % left",
                     "10 % or less is right"});
  if (tendon.stitches != 0)
    facts.push_back({title + ", thread", counted(tendon.passes(), "pass", "passes"),
                     "Each holds 25 N of the board's pull"});
  if (tendon.folds > 0)
    facts.push_back({title, std::to_string(tendon.folds) + " strands", "At its post"});
}

// What a rule that wants a place seen still misses; empty: the place is not in the picture.
std::string missing_of(const Rule& rule, const ScopeOptics& optics, const Pose& X_WT,
                       const Case& the_case, const BoneSnapshot& bones, const Vec3& p_W) {
  const ScopeView view = view_through(optics, X_WT);
  const auto at = place_in_picture(optics, view, the_case, bones, p_W);
  if (!at) return {};
  const auto& number = rule.numbers;
  const double mm = 1e3 * at->distance_m;
  if (at->hidden) return "behind bone";
  if (mm > number.at("far_mm")) return in_mm_to_tenths(at->distance_m) + ", too far";
  if (mm < number.at("near_mm")) return in_mm_to_tenths(at->distance_m) + ", too near";
  if (at->share > number.at("central")) return "not central enough";
  return std::abs(turn_deg(view)) > number.at("level_deg") ? "tilted" : "hold it";
}

}  // namespace

std::vector<ExerciseModel::Told> sights_of(const ScenarioPlan& plan, const ScenarioState& state,
                                           const Case& the_case, std::span<const PlannedHand> hands,
                                           std::span<const ToolState> tools,
                                           const BoneSnapshot& bones) {
  Facts facts;
  if (state.stage >= plan.goals.size()) return facts;
  const auto& goals = plan.goals[state.stage];
  for (std::size_t g = 0; g < std::min(goals.size(), state.goals.size()); ++g) {
    const PlannedRule& goal = goals[g];
    if (goal.rule.kind != "seen" || state.goals[g].met) continue;
    for (std::size_t h = 0; h < std::min(hands.size(), tools.size()); ++h) {
      if (!hands[h].optics || (goal.hand != kNoHand && goal.hand != h)) continue;
      for (std::size_t i = 0; i < goal.bones.size(); ++i) {
        const auto& done = state.goals[g].done;
        if ((i < done.size() && done[i] != 0) || goal.bones[i] >= the_case.landmarks.size())
          continue;
        const Vec3 p_W = place_now(the_case, goal.bones[i], bones);
        const std::string missing =
            missing_of(goal.rule, *hands[h].optics, tools[h].X_WP, the_case, bones, p_W);
        if (!missing.empty())
          facts.push_back({label_of(the_case.landmarks[goal.bones[i]].name), missing,
                           "In the middle of the picture, near enough and not hidden, it counts"});
      }
    }
  }
  return facts;
}

std::vector<ExerciseModel::Told> facts_of(const GraftWatch& graft) {
  Facts facts;
  if (!graft.plan()) return facts;
  const GraftBenchState& bench = graft.state();
  for (std::size_t k = 0; bench.loop_m == 0 && k < kGraftTendons; ++k)
    add_tendon(kTendonTitles[k], bench.tendons[k], facts);
  if (bench.passed_m > 0)
    facts.push_back({"Graft's cylinder", in_mm_to_tenths(bench.passed_m),
                     "The smallest one that went over the graft: so wide the tunnels should be"});
  if (bench.tension_n > 0)
    facts.push_back(
        {"Board's pull", std::to_string(std::lround(bench.tension_n)) + " N", "80 N are right"});
  if (bench.tension_n > 0 || bench.creep_s > 0)
    facts.push_back({"Graft stretched", std::to_string(std::lround(bench.creep_s / 60)) + " min",
                     "As if by 80 N; 10 minutes are right"});
  if (!(graft.plan()->channel_m > 0)) return facts;
  facts.push_back({"Femoral channel", in_mm_to_tenths(graft.plan()->channel_m),
                   "From the joint to the far cortex: the loop and the graft in the socket"});
  facts.push_back({"Femoral socket", in_mm_to_tenths(graft.plan()->socket_m),
                   "6 mm longer than the graft in it, for the button to turn"});
  return facts;
}

std::vector<ExerciseModel::Told> fascia_of(const GraftWatch& graft) {
  Facts facts;
  if (!graft.plan() || !graft.plan()->is_covered()) return facts;
  const double open_m = fascia_open_m(*graft.plan(), graft.state());
  facts.push_back({"Fascia, open", so_far(open_m, graft.plan()->fascia_m()),
                   "Along the mark between both tendons, with the blade"});
  for (std::size_t k = 0; k < kGraftTendons; ++k)
    facts.push_back({kTendonTitles[k],
                     graft.state().tendons[k].found ? "found" : "under the fascia",
                     "Lifted 10 mm out of the slit by the clamp it is found"});
  return facts;
}

std::vector<ExerciseModel::Told> bands_of(const GraftWatch& graft) {
  Facts facts;
  for (std::size_t k = 0; graft.plan() && k < kGraftTendons; ++k) {
    const TendonOnBench& tendon = graft.state().tendons[k];
    if (tendon.stripped || tendon.amputated) continue;
    facts.push_back({std::string(kTendonTitles[k]) + ", bands",
                     std::to_string(std::popcount(tendon.bands_cut)) + " of " +
                         std::to_string(graft.plan()->tendons[k].bands_W.size()) + " cut",
                     "A stripper that is pushed through a band cuts the tendon off"});
  }
  return facts;
}

std::vector<ExerciseModel::Told> facts_of(const PlacingWatch& placing) {
  Facts facts;
  const auto plan = placing.plan();
  if (!plan) return facts;
  const GraftPlacingState& state = placing.state();
  const double through_m = plan->femur.length_m() + GraftPlacing::kThrough_m;
  switch (state.phase) {
    case PlacingPhase::kEmpty:
      if (state.pin_m > 0)
        facts.push_back({"Passing pin", so_far(state.pin_m, through_m),
                         "From the socket's mouth to 10 mm beyond the far cortex"});
      if (state.lost > 0)
        facts.push_back({"Thread", "lost", "Its end was taken along, or was let go in a tunnel"});
      break;
    case PlacingPhase::kThreadInside:
      facts.push_back({"Thread", "through the femur", "Its end lies over the tibial tunnel"});
      break;
    case PlacingPhase::kThreadHeld:
      facts.push_back({"Thread", "in the jaws", "Draw its end out, and open them"});
      break;
    case PlacingPhase::kThreadOut:
      facts.push_back({"Graft drawn in", so_far(state.drawn_m, plan->button_out_m()),
                       "Where the mark on the graft says that the button is out"});
      break;
    case PlacingPhase::kTurned:
      if (state.screw.in_m > 0)
        facts.push_back({"Screw", whole_mm(state.screw.in_m) + " deep", "20 mm or more hold"});
      break;
  }
  return facts;
}

std::string words_of_goal(std::string_view kind) {
  constexpr std::array<std::pair<std::string_view, const char*>, 8> kWords{{
      {"knee_examined", "test Lachman and pivot shift"},
      {"knee_cycled", "stretch the knee out and bend it"},
      {"screw_in", "turn the screw in"},
      {"graft_tested", "a graft that holds"},
      {"fascia_opened", "open the fascia"},
      {"tendons_found", "lift both tendons out"},
      {"muscle_off", "scrape the muscle off"},
      {"tendons_stitched", "thread through both ends"},
  }};
  for (const auto& [name, words] : kWords)
    if (name == kind) return words;
  return {};
}

bool is_whole(const Outcome& outcome) {
  return std::all_of(outcome.stages.begin(), outcome.stages.end(),
                     [](const Outcome::Stage& stage) { return stage.completed_s.has_value(); });
}

std::string why_of(const Outcome& outcome, const std::optional<double>& pass_score) {
  if (outcome.verdict == Verdict::kPassed) return {};
  if (!is_whole(outcome)) return "Not every stage was done.";
  const auto is_grave = [](const Outcome::Error& made) {
    return made.severity != Severity::kMinor;
  };
  if (std::any_of(outcome.errors.begin(), outcome.errors.end(), is_grave))
    return "An error was made that does not let an attempt pass.";
  if (!outcome.score || !pass_score) return {};
  const std::string mark = std::to_string(std::lround(*pass_score));
  return outcome.verdict == Verdict::kNotPassed
             ? "All was done without a grave error; " + mark + " points are needed."
             : "The interval of your score includes the " + mark + " that are needed: try again.";
}

}  // namespace osteon
