#include "runs/reports/placing_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "osteon/scene/graft.h"

namespace osteon {
namespace {

constexpr const char* kThreadNames[] = {"none", "in_joint", "held", "out", "out"};

bool has_turned(const PlacingReport& report) { return report.state.phase == PlacingPhase::kTurned; }

double socket_filled_m(const PlacingReport& report) {
  return fit_loop(report.plan.femur.length_m(), report.plan.socket_m, report.plan.loop_m)
      .in_socket_m;
}

}  // namespace

nlohmann::ordered_json to_json(const PlacingReport& report) {
  const PlacingPlan& plan = report.plan;
  const GraftPlacingState& state = report.state;
  nlohmann::ordered_json json;
  json["tibia_mm"] = 1e3 * plan.tibia.length_m();
  json["between_mm"] = 1e3 * plan.between_m;
  json["channel_mm"] = 1e3 * plan.femur.length_m();
  json["socket_mm"] = 1e3 * plan.socket_m;
  json["graft_mm"] = 1e3 * plan.graft_m;
  json["loop_mm"] = 1e3 * plan.loop_m;
  json["thread"] = kThreadNames[static_cast<std::size_t>(state.phase)];
  json["thread_lost"] = state.lost;
  json["let_go_early"] = state.let_go_early;
  json["drawn_mm"] = 1e3 * state.drawn_m;
  json["button_out_mm"] = 1e3 * plan.button_out_m();
  json["most_pull_n"] = state.most_pull_n;
  json["button_turned"] = has_turned(report);
  json["gap_mm"] = nullptr;
  json["in_socket_mm"] = nullptr;
  if (!has_turned(report)) return json;
  json["gap_mm"] = 1e3 * state.gap_m;
  json["in_socket_mm"] = 1e3 * (socket_filled_m(report) + state.gap_m);
  return json;
}

std::string to_text(const PlacingReport& report) {
  std::string text;
  char line[160];
  const auto add = [&](const char* what, double value, const char* unit) {
    std::snprintf(line, sizeof line, "%-44s %6.1f %s\n", what, value, unit);
    text += line;
  };
  if (report.state.lost > 0) add("thread: lost", report.state.lost, "times");
  add("graft: drawn in", 1e3 * report.state.drawn_m, "mm");
  add("graft: largest pull", report.state.most_pull_n, "N");
  if (!has_turned(report)) return text + "button: has not turned\n";
  add("button: turned, gap to the cortex", 1e3 * report.state.gap_m, "mm");
  return text;
}

}  // namespace osteon
