#include "commands/shapes/skin_report.h"

#include <nlohmann/json.hpp>

#include "checkup/printed.h"

namespace osteon {
namespace {

constexpr double kMm = 1000, kMm2 = 1e6, kMm3 = 1e9;

nlohmann::json two_of(const SheetPoint& p) { return {kMm * p.x(), kMm * p.y()}; }

nlohmann::json three_of_skin(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json json_of(const SkinPierceResult& pierce) {
  nlohmann::json out = {{"at_mm", two_of(pierce.thrust.disc.p)},
                        {"radius_mm", kMm * pierce.thrust.disc.radius_m},
                        {"pierced", pierce.pierced},
                        {"peak_n", pierce.peak_n},
                        {"peak_depth_mm", kMm * pierce.peak_depth_m},
                        {"deepest_n", pierce.deepest_n},
                        {"pull_n", pierce.pull_n},
                        {"hole_mm", kMm * pierce.law.hole_m},
                        {"curve", nlohmann::json::array()}};
  for (const SkinPierceResult::Point& p : pierce.curve)
    out["curve"].push_back(
        {{"time_s", p.time_s}, {"depth_mm", kMm * p.depth_m}, {"force_n", p.force_n}});
  return out;
}

}  // namespace

std::string skin_report_json(const SkinResult& result, const std::optional<Pose>& X_WS) {
  nlohmann::json json = {{"vertices", result.vertices},
                         {"triangles", result.triangles},
                         {"groove_triangles", result.groove_triangles},
                         {"opening_mm2", kMm2 * result.opening_m2},
                         {"widest_mm", kMm * result.widest_m},
                         {"groove_mm3", kMm3 * result.groove_m3},
                         {"cuts", nlohmann::json::array()},
                         {"presses", nlohmann::json::array()},
                         {"pierces", nlohmann::json::array()}};
  for (const SkinCutResult& cut : result.cuts)
    json["cuts"].push_back({{"stroke_mm", kMm * cut.stroke_m},
                            {"opened_mm", kMm * cut.opened_m},
                            {"off_mm", kMm * cut.off_m}});
  for (const SkinPressResult& press : result.presses)
    json["presses"].push_back({{"at_mm", two_of(press.press.disc.p)},
                               {"radius_mm", kMm * press.press.disc.radius_m},
                               {"force_n", press.press.force_n},
                               {"dent_mm", kMm * press.dent_m},
                               {"stiffness_n_per_m", press.stiffness_n_per_m}});
  for (const SkinPierceResult& pierce : result.pierces) json["pierces"].push_back(json_of(pierce));
  if (X_WS)
    json["place"] = {{"at_mm", three_of_skin(kMm * X_WS->p)},
                     {"x", three_of_skin(X_WS->rotate(Vec3::UnitX()))},
                     {"y", three_of_skin(X_WS->rotate(Vec3::UnitY()))},
                     {"z", three_of_skin(X_WS->rotate(Vec3::UnitZ()))}};
  return json.dump(2) + "\n";
}

std::string skin_report_text(const SkinResult& result, const std::optional<Pose>& X_WS) {
  std::string out = printed("%zu vertices, %zu triangles of skin, %zu of grooves\n",
                            result.vertices, result.triangles, result.groove_triangles);
  if (X_WS)
    out += printed("its middle is at (%.1f, %.1f, %.1f) mm\n", kMm * X_WS->p.x(), kMm * X_WS->p.y(),
                   kMm * X_WS->p.z());
  for (const SkinCutResult& cut : result.cuts)
    out += printed("cut: stroke of %.1f mm, open over %.1f mm, at most %.2f mm beside the stroke\n",
                   kMm * cut.stroke_m, kMm * cut.opened_m, kMm * cut.off_m);
  if (result.groove_triangles > 0)
    out += printed(
        "lips: %.1f mm apart at most, %.1f mm2 between them; volume of the grooves %.0f mm3\n",
        kMm * result.widest_m, kMm2 * result.opening_m2, kMm3 * result.groove_m3);
  for (const SkinPressResult& press : result.presses)
    out += printed(
        "press at (%.1f, %.1f) mm with %.3g N: dent of %.2f mm; stiffness under a light press: "
        "%.0f N/m\n",
        kMm * press.press.disc.p.x(), kMm * press.press.disc.p.y(), press.press.force_n,
        kMm * press.dent_m, press.stiffness_n_per_m);
  for (const SkinPierceResult& pierce : result.pierces) {
    const SheetPoint p = kMm * pierce.thrust.disc.p;
    if (!pierce.pierced)
      out += printed("pierce at (%.1f, %.1f) mm: not through, %.1f N at most\n", p.x(), p.y(),
                     pierce.peak_n);
    else
      out += printed(
          "pierce at (%.1f, %.1f) mm: peak %.1f N at %.1f mm, %.1f N at the deepest point, %.1f N "
          "on the way back\n",
          p.x(), p.y(), pierce.peak_n, kMm * pierce.peak_depth_m, pierce.deepest_n, pierce.pull_n);
  }
  return out;
}

}  // namespace osteon
