#include "runs/reports/graft_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "osteon/procedure/graft_watch.h"

namespace osteon {
namespace {

using GraftJson = nlohmann::ordered_json;

constexpr const char* kTendonTitles[] = {"semitendinosus", "gracilis"};

GraftJson tendon_json(const GraftReport& report, std::size_t t) {
  const TendonOnBench& is = report.state.tendons[t];
  const TendonMeasures& measures = report.plan.tendons[t].measures;
  const auto out = harvested(report.plan, report.state, t);
  GraftJson json{{"name", kTendonTitles[t]},
                 {"length_mm", 1e3 * measures.length_m},
                 {"area_mm2", 1e6 * measures.area_m2},
                 {"harvested_mm", nullptr},
                 {"amputated", is.amputated},
                 {"strands", is.folds},
                 {"muscle_left_pct", nullptr},
                 {"stitches", is.passes()},
                 {"found", is.found}};
  if (out) json["harvested_mm"] = 1e3 * out->length_m;
  if (out) json["muscle_left_pct"] = 100 * is.muscle_left();
  return json;
}

// A finite number of a JSON object, within bounds.
Result<double> number_in(const nlohmann::json& json, const char* key, double most,
                         const std::string& where) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number())
    return fail("has no number '" + std::string(key) + "'", where,
                "Give the report of a run of acl_graft that made a graft");
  const double value = found->get<double>();
  if (!std::isfinite(value) || value < 0 || value > most)
    return fail("'" + std::string(key) + "' must be 0 to " + std::to_string(most), where);
  return value;
}

}  // namespace

GraftJson to_json(const GraftReport& report) {
  GraftJson json;
  json["tendons"] = GraftJson::array({tendon_json(report, 0), tendon_json(report, 1)});
  if (report.plan.is_covered()) json["fascia_mm"] = 1e3 * fascia_open_m(report.plan, report.state);
  json["channel_mm"] = 1e3 * report.plan.channel_m;
  json["socket_mm"] = 1e3 * report.plan.socket_m;
  const auto graft = graft_on(report.plan, report.state);
  if (!graft) return json;
  json["strands"] = graft->strands;
  json["length_mm"] = 1e3 * graft->length_m;
  json["diameter_mm"] = 1e3 * graft->diameter_m;
  json["sizer_mm"] = 1e3 * graft->sized_m;
  json["sizer_found_mm"] = 1e3 * report.state.passed_m;
  json["tension_n"] = report.state.tension_n;
  json["pretension_s"] = report.state.creep_s;
  json["creep_left_pct"] = 100 * creep_left(report.state.creep_s);
  if (!(report.state.loop_m > 0)) return json;
  const LoopFit fit = fit_loop(report.plan.channel_m, report.plan.socket_m, report.state.loop_m);
  json["loop_mm"] = 1e3 * report.state.loop_m;
  json["in_socket_mm"] = 1e3 * fit.in_socket_m;
  json["button_turns"] = fit.flips;
  return json;
}

std::string to_text(const GraftReport& report) {
  std::string text;
  char line[160];
  const auto add = [&](const char* what, double value, const char* unit) {
    std::snprintf(line, sizeof line, "%-44s %6.1f %s\n", what, value, unit);
    text += line;
  };
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    const auto out = harvested(report.plan, report.state, t);
    if (!out) continue;
    const std::string what = std::string(kTendonTitles[t]) + ": harvested";
    add(what.c_str(), 1e3 * out->length_m, out->amputated ? "mm, cut off at a band" : "mm");
  }
  const auto graft = graft_on(report.plan, report.state);
  if (!graft) return text + "no graft was made\n";
  add("graft: strands", graft->strands, "");
  add("graft: length", 1e3 * graft->length_m, "mm");
  add("graft: passes a cylinder of", 1e3 * graft->sized_m, "mm");
  add("graft: passes of thread, in the tendon with fewer", fewest_passes(report.state), "");
  add("graft: creep left", 100 * creep_left(report.state.creep_s), "%");
  if (!(report.state.loop_m > 0)) return text;
  const LoopFit fit = fit_loop(report.plan.channel_m, report.plan.socket_m, report.state.loop_m);
  add("loop", 1e3 * report.state.loop_m, "mm");
  add("graft in the socket", 1e3 * fit.in_socket_m,
      fit.flips ? "mm" : "mm, the button cannot turn");
  return text;
}

Result<MadeGraft> made_graft(const std::string& json_text, const std::string& where) {
  auto json = nlohmann::json::parse(json_text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return fail("is not a JSON object", where);
  // In the report of a whole reconstruction `acl.graft` is what holds it.
  for (const char* key : {"acl", "made", "graft"})
    if (json.contains(key) && json[key].is_object()) json = nlohmann::json(json[key]);
  MadeGraft made;
  const struct {
    const char* key;
    double most;
    double* into;
    double unit;
  } rows[] = {{"length_mm", 500, &made.length_m, 1e-3},
              {"diameter_mm", 20, &made.diameter_m, 1e-3},
              {"loop_mm", 60, &made.loop_m, 1e-3},
              {"pretension_s", 1e6, &made.creep_s, 1}};
  for (const auto& row : rows) {
    const auto value = number_in(json, row.key, row.most, where);
    if (!value) return tl::unexpected(value.error());
    *row.into = row.unit * *value;
  }
  return made;
}

}  // namespace osteon
