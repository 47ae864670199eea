#include "window/controllers/sessions/exercise_facts.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "osteon/physics/graft_placing.h"

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

void add_tendon(const std::string& title, const TendonOnBench& tendon, Facts& facts) {
  if (tendon.amputated)
    facts.push_back({title, "cut off", "At a band that the stripper was pushed through"});
  else if (tendon.front_m > 0 && !tendon.stripped)
    facts.push_back({title, whole_mm(tendon.front_m) + " stripped",
                     "How far the stripper has come from the insertion"});
  if (tendon.scraped_m > 0)
    facts.push_back({title + ", muscle",
                     std::to_string(std::lround(100 * tendon.muscle_left())) + " % left",
                     "10 % or less is right"});
  if (tendon.stitches != 0)
    facts.push_back({title + ", thread", std::to_string(tendon.passes()) + " passes",
                     "Each holds 25 N of the board's pull"});
  if (tendon.folds > 0)
    facts.push_back({title, std::to_string(tendon.folds) + " strands", "At its post"});
}

}  // namespace

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

}  // namespace osteon
