#include "runs/reports/placing_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

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

namespace {

double divergence_deg(const PlacingReport& report) {
  const PlacingTunnel& tibia = report.plan.tibia;
  const double cosine = report.state.screw.out_B.dot((tibia.outer_B - tibia.mouth_B).normalized());
  return 180 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

// Length of the graft's way by flexion, where the knee was bent.
void add_bent(const BentGraft& bent, nlohmann::ordered_json& json) {
  auto lengths = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < bent.lengths_m.size(); ++i)
    if (bent.lengths_m[i] > 0)
      lengths.push_back({{"flexion_deg", 10 * i}, {"between_mm", 1e3 * bent.lengths_m[i]}});
  if (lengths.empty()) return;
  json["bent"] = std::move(lengths);
  json["bent_excursion_mm"] = 1e3 * excursion_m(bent);
}

nlohmann::ordered_json screw_json(const PlacingReport& report) {
  const PlacingScrew& screw = report.state.screw;
  nlohmann::ordered_json json;
  json["width_mm"] = 1e3 * screw.width_m;
  json["tunnel_mm"] = 2e3 * report.plan.tibia.radius_m;
  json["deep_mm"] = 1e3 * screw.in_m;
  json["divergence_deg"] = divergence_deg(report);
  json["tension_n"] = screw.tension_n;
  json["flexion_deg"] = screw.flexion_deg;
  json["cycles"] = screw.cycles;
  return json;
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
  add_bent(report.bent, json);
  if (state.screw.done) json["screw"] = screw_json(report);
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
  if (const double change = excursion_m(report.bent); change > 0)
    add("graft: change of length while bent", 1e3 * change, "mm");
  const PlacingScrew& screw = report.state.screw;
  if (!screw.done) return text;
  add("screw: width", 1e3 * screw.width_m, "mm");
  add("screw: depth", 1e3 * screw.in_m, "mm");
  add("screw: angle to the tunnel", divergence_deg(report), "degrees");
  add("screw: tension when released", screw.tension_n, "N");
  add("screw: flexion when released", screw.flexion_deg, "degrees");
  add("screw: cycles under tension before it", screw.cycles, "");
  return text;
}

}  // namespace osteon
