#include "commands/shapes/tissue_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "checkup/printed.h"

namespace osteon {
namespace {

nlohmann::json three_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Names of files may be any bytes; JSON is UTF-8.
std::string utf8_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

const char* support_kind(const SolveReaction& reaction) {
  return reaction.of_moved ? "moved" : "fixed";
}

double element_steps_per_s(const SolveResult& result, double wall_s) {
  const double work = static_cast<double>(result.elements) * static_cast<double>(result.steps);
  return wall_s > 0 ? work / wall_s : 0;
}

std::string three_numbers(const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%12.6g %12.6g %12.6g", v.x(), v.y(), v.z());
  return text;
}

}  // namespace

std::string solve_report_json(const SolveResult& result, double wall_s) {
  nlohmann::json json = {{"strain_energy_mj", 1000 * result.energy.strain_j},
                         {"kinetic_energy_mj", 1000 * result.energy.kinetic_j},
                         {"hourglass_energy_mj", 1000 * result.energy.hourglass_j},
                         {"elements", result.elements},
                         {"steps", result.steps},
                         {"step_s", result.step_s},
                         {"element_steps_per_s", element_steps_per_s(result, wall_s)},
                         {"settled", result.settled},
                         {"probes", nlohmann::json::array()},
                         {"reactions", nlohmann::json::array()}};
  for (const SolveProbe& probe : result.probes)
    json["probes"].push_back(
        {{"at_mm", three_of(1000 * probe.at_m)}, {"moved_mm", three_of(1000 * probe.moved_m)}});
  for (const SolveReaction& reaction : result.reactions)
    json["reactions"].push_back({{"of", support_kind(reaction)},
                                 {"index", reaction.index},
                                 {"force_n", three_of(reaction.force_n)}});
  for (std::size_t i = 0; i < result.reactions.size(); ++i)
    if (result.reactions[i].moment_n_m)
      json["reactions"][i]["moment_n_mm"] = three_of(1000 * *result.reactions[i].moment_n_m);
  if (result.lost)
    json["lost"] = {{"part", result.lost->part},
                    {"at_mm", three_of(1000 * result.lost->at_m)},
                    {"time_s", result.lost->time_s}};
  return utf8_text(json);
}

std::string solve_report_text(const SolveResult& result, double wall_s) {
  std::string out = printed("%zu elements, %llu steps of %.4g s, %.3g element-steps a second\n",
                            result.elements, static_cast<unsigned long long>(result.steps),
                            result.step_s, element_steps_per_s(result, wall_s));
  for (const SolveProbe& probe : result.probes)
    out += "probe at " + three_numbers(1000 * probe.at_m) + " mm moved " +
           three_numbers(1000 * probe.moved_m) + " mm\n";
  for (const SolveReaction& reaction : result.reactions)
    out += printed("%s[%zu] pushes the body with ", support_kind(reaction), reaction.index) +
           three_numbers(reaction.force_n) + " N\n";
  out += printed("energy: strain %.6g mJ, hourglass %.6g mJ, kinetic %.6g mJ\n",
                 1000 * result.energy.strain_j, 1000 * result.energy.hourglass_j,
                 1000 * result.energy.kinetic_j);
  return out + (result.settled ? "settled\n" : "not settled: still moving at the end\n");
}

}  // namespace osteon
