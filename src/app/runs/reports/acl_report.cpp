#include "runs/reports/acl_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "osteon/base/file.h"

namespace osteon {
namespace {

using AclJson = nlohmann::ordered_json;

constexpr double kTurn_deg = 180 / std::numbers::pi;

AclJson place_json(const Vec3& p) {
  return AclJson::array({1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z()});
}

AclJson femur_json(const FemoralTunnel& t) {
  return {{"aperture_mm", place_json(t.aperture_W)},
          {"depth_pct", 100 * t.depth_share},
          {"height_pct", 100 * t.height_share},
          {"off_target_mm", 1e3 * t.off_target_m},
          {"from_roof_deg", kTurn_deg * t.from_roof_rad},
          {"channel_mm", 1e3 * t.channel_m},
          {"drilled_mm", 1e3 * t.drilled_m},
          {"diameter_mm", 1e3 * t.diameter_m},
          {"back_wall_mm", 1e3 * t.back_wall_m},
          {"blow_out", t.blow_out},
          {"through", t.through}};
}

AclJson tibia_json(const TibialTunnel& t) {
  return {
      {"aperture_mm", place_json(t.aperture_W)}, {"amis_jakob_pct", 100 * t.front_share},
      {"medial_pct", 100 * t.medial_share},      {"length_mm", 1e3 * t.length_m},
      {"diameter_mm", 1e3 * t.diameter_m},       {"to_plateau_deg", kTurn_deg * t.to_plateau_rad},
      {"behind_roof_mm", 1e3 * t.behind_roof_m}, {"through", t.through}};
}

AclJson before_json(const AclReport& report) {
  const auto mm = [](const std::optional<double>& m) { return m ? AclJson(1e3 * *m) : AclJson(); };
  AclJson out;
  out["femur"] = report.before->femur ? femur_json(*report.before->femur) : AclJson();
  out["tibia"] = report.before->tibia ? tibia_json(*report.before->tibia) : AclJson();
  out["to_new_femur_mm"] = mm(report.femur_to_old_m);
  out["to_new_tibia_mm"] = mm(report.tibia_to_old_m);
  return out;
}

AclJson fixed_json(const GraftOutcome& graft) {
  const FixedGraft& fixed = *graft.fixed;
  AclJson json{{"diameter_mm", 1e3 * graft.diameter_m},
               {"in_socket_mm", 1e3 * fixed.in_socket_m},
               {"in_tibia_mm", 1e3 * fixed.in_tibia_m},
               {"screw_engaged_mm", 1e3 * fixed.engaged_m},
               {"fixation_n_per_mm", 1e-3 * fixed.stiffness_n_per_m},
               {"strength_n", fixed.strength_n},
               {"slack_mm", 1e3 * fixed.slack_m},
               {"fixed", fixed.held},
               {"holds", graft.holds}};
  if (!fixed.held) json["why"] = fixed.why;
  return json;
}

AclJson passed_json(const PassedGraft& passed) {
  AclJson json{{"most_pull_n", passed.most_pull_n},
               {"most_pull_at_mm", 1e3 * passed.most_pull_at_m},
               {"last_pull_n", passed.last_pull_n},
               {"drawn_mm", 1e3 * passed.end_m},
               {"button_turns", passed.turns}};
  if (!passed.turns) json["why"] = passed.why;
  return json;
}

AclJson bending_json(const GraftOutcome& graft) {
  AclJson out = AclJson::array();
  for (const GraftBend& at : graft.bends)
    out.push_back({{"flexion_deg", at.flexion_deg},
                   {"femur_deg", kTurn_deg * at.femur_rad},
                   {"tibia_deg", kTurn_deg * at.tibia_rad}});
  return out;
}

double most_bent_deg(const GraftOutcome& graft) {
  double most = 0;
  for (const GraftBend& at : graft.bends) most = std::max(most, kTurn_deg * at.femur_rad);
  return most;
}

AclJson test_json(const KneeLaxity& found, double whole_m, double ahead_m) {
  return {{"anterior_mm", 1e3 * found.anterior_m},
          {"whole_anterior_mm", 1e3 * whole_m},
          {"side_difference_mm", 1e3 * (found.anterior_m - whole_m)},
          {"ahead_of_whole_mm", 1e3 * ahead_m},
          {"internal_rotation_deg", kTurn_deg * found.internal_rad},
          {"graft_n", found.ligaments.empty() ? 0 : found.ligaments.back().tension_n},
          {"converged", found.converged}};
}

AclJson isometry_of(const GraftOutcome& graft) {
  AclJson out{{"excursion_mm", 1e3 * graft.excursion_m}, {"lengths", AclJson::array()}};
  for (const LineLength& at : graft.lengths)
    out["lengths"].push_back({{"flexion_deg", at.flexion_deg},
                              {"length_mm", 1e3 * at.length_m},
                              {"change_mm", 1e3 * (at.length_m - graft.lengths.front().length_m)}});
  return out;
}

void add_line(std::string& text, const char* what, double value, const char* unit) {
  char line[96];
  std::snprintf(line, sizeof line, "%-32s %8.1f %s\n", what, value, unit);
  text += line;
}

void add_femur(std::string& text, const FemoralTunnel& t) {
  add_line(text, "femur: depth", 100 * t.depth_share, "%");
  add_line(text, "femur: height", 100 * t.height_share, "%");
  add_line(text, "femur: off the footprint", 1e3 * t.off_target_m, "mm");
  add_line(text, "femur: from twelve o'clock", kTurn_deg * t.from_roof_rad, "degrees");
  add_line(text, "femur: channel", 1e3 * t.channel_m, "mm");
  add_line(text, "femur: drilled", 1e3 * t.drilled_m, "mm");
  add_line(text, "femur: back wall", 1e3 * t.back_wall_m, t.blow_out ? "mm, breached" : "mm");
}

void add_tibia(std::string& text, const TibialTunnel& t) {
  add_line(text, "tibia: Amis-Jakob", 100 * t.front_share, "%");
  add_line(text, "tibia: from the medial border", 100 * t.medial_share, "%");
  add_line(text, "tibia: length", 1e3 * t.length_m, "mm");
  add_line(text, "tibia: behind the intercondylar roof line", 1e3 * t.behind_roof_m, "mm");
}

}  // namespace

Result<LigamentTable> shipped_ligaments() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_ligament_table(*data / "assets/tissue/knee_ligaments.toml");
}

Result<AclReport> make_acl_report(const CaseDef& def, const AclDrilling& drilling,
                                  const std::optional<GraftChoices>& choices) {
  auto tunnels = measure_tunnels(def, drilling);
  if (!tunnels) return tl::unexpected(tunnels.error());
  AclReport report;
  report.tunnels = std::move(*tunnels);
  if (!report.tunnels.femur || !report.tunnels.tibia) return report;
  const auto table = shipped_ligaments();
  if (!table) return tl::unexpected(table.error());
  auto graft = graft_outcome(def, *table, report.tunnels, choices);
  if (!graft) return tl::unexpected(graft.error());
  report.graft = std::move(*graft);
  return report;
}

AclJson to_json(const AclReport& report) {
  AclJson out;
  out["femur"] = report.tunnels.femur ? femur_json(*report.tunnels.femur) : AclJson();
  out["tibia"] = report.tunnels.tibia ? tibia_json(*report.tunnels.tibia) : AclJson();
  if (report.before) out["before"] = before_json(report);
  if (!report.graft) return out;
  out["isometry"] = isometry_of(*report.graft);
  out["impingement"] = {{"roof_gap_mm", 1e3 * report.graft->roof_gap_m},
                        {"impinges", report.graft->roof_gap_m < 0}};
  out["bending"] = bending_json(*report.graft);
  if (report.graft->passed) out["passing"] = passed_json(*report.graft->passed);
  if (report.graft->fixed) out["graft"] = fixed_json(*report.graft);
  out["lachman"] = test_json(report.graft->lachman, report.graft->lachman_whole_m,
                             report.graft->lachman_ahead_m);
  out["pivot"] =
      test_json(report.graft->pivot, report.graft->pivot_whole_m, report.graft->pivot_ahead_m);
  return out;
}

std::string with_tunnels(const std::string& attempt_json, const std::optional<AclReport>& report,
                         const std::string& not_measured) {
  if (!report) return attempt_json;
  auto json = AclJson::parse(attempt_json);
  json["acl"] = to_json(*report);
  if (!not_measured.empty()) json["acl"]["not_measured"] = not_measured;
  return json.dump(2) + "\n";
}

std::string to_text(const AclReport& report) {
  std::string text;
  if (report.tunnels.femur) add_femur(text, *report.tunnels.femur);
  if (report.tunnels.tibia) add_tibia(text, *report.tunnels.tibia);
  if (report.femur_to_old_m)
    add_line(text, "femur: bone to the old socket", 1e3 * *report.femur_to_old_m, "mm");
  if (report.tibia_to_old_m)
    add_line(text, "tibia: bone to the old tunnel", 1e3 * *report.tibia_to_old_m, "mm");
  if (!report.graft) return text;
  const GraftOutcome& graft = *report.graft;
  add_line(text, "graft: length changes by", 1e3 * graft.excursion_m, "mm over flexion");
  add_line(text, "graft: space under the roof", 1e3 * graft.roof_gap_m,
           graft.roof_gap_m < 0 ? "mm, the roof impinges on it" : "mm");
  add_line(text, "graft: turns at the femoral mouth by", most_bent_deg(graft), "degrees at most");
  if (graft.passed) {
    add_line(text, "graft: drawn in with", graft.passed->most_pull_n, "N at most");
    add_line(text, "graft: drawn in over", 1e3 * graft.passed->end_m, "mm");
    if (!graft.passed->turns) text += "button: does not turn, " + graft.passed->why + "\n";
  }
  if (graft.fixed) {
    add_line(text, "graft: in the femoral socket", 1e3 * graft.fixed->in_socket_m, "mm");
    add_line(text, "graft: screw engages", 1e3 * graft.fixed->engaged_m, "mm");
    add_line(text, "graft: fixation holds", graft.fixed->strength_n, "N");
    add_line(text, "graft: slack", 1e3 * graft.fixed->slack_m, "mm");
    if (!graft.fixed->held) text += "graft: not fixed, " + graft.fixed->why + "\n";
  }
  add_line(text, "Lachman: more than the intact knee",
           1e3 * (graft.lachman.anterior_m - graft.lachman_whole_m), "mm");
  add_line(text, "Lachman: tibia ahead of the intact knee's", 1e3 * graft.lachman_ahead_m, "mm");
  add_line(text, "pivot: more than the intact knee",
           1e3 * (graft.pivot.anterior_m - graft.pivot_whole_m), "mm");
  return text;
}

}  // namespace osteon
