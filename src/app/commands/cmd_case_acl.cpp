#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_bone.h"
#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/cmd_case_laxity.h"
#include "commands/parser.h"
#include "osteon/carve/measure_holes.h"
#include "runs/acl_report.h"

namespace osteon {
namespace {

struct AclCommand {
  std::string spec, drilled;
  std::string femur_from, femur_to, tibia_from, tibia_to;
  double diameter_mm = 8, roundness_mm = 0.3;
  bool json = false;
};

Result<std::optional<DrilledLine>> line_between(const std::string& from, const std::string& to,
                                                double diameter_mm, const char* option) {
  if (from.empty() && to.empty()) return std::optional<DrilledLine>();
  if (from.empty() || to.empty())
    return fail(
        "needs both ends", option,
        "Give --" + std::string(option) + "-from and --" + option + "-to as x,y,z in mm, World");
  const auto a = point_from_mm(from, std::string("--") + option + "-from");
  if (!a) return tl::unexpected(a.error());
  const auto b = point_from_mm(to, std::string("--") + option + "-to");
  if (!b) return tl::unexpected(b.error());
  return std::optional<DrilledLine>(DrilledLine{*a, *b, diameter_mm / 1000});
}

// Of the holes of a bone the longest that a graft fits in.
std::optional<DrilledLine> hole_in(const CaseDef& drilled, const char* name,
                                   const HoleOptions& how) {
  std::optional<DrilledLine> best;
  double longest = 0;
  for (const BoneDef& bone : drilled.bones) {
    if (bone.name != name) continue;
    for (const Hole& hole : find_holes(bone.mesh, how)) {
      if (!(hole.length_m > longest)) continue;
      longest = hole.length_m;
      best = DrilledLine{bone.X_WB * hole.entry, bone.X_WB * hole.exit, hole.diameter_m};
    }
  }
  return best;
}

Result<AclDrilling> holes_in(const AclCommand& command) {
  const auto drilled = open_case_def(command.drilled, {}, CaseParts::kFelt);
  if (!drilled) return tl::unexpected(drilled.error());
  HoleOptions how;
  how.least_diameter_m = 0.004;
  how.largest_diameter_m = 0.014;
  how.roundness_m = command.roundness_mm / 1000;
  AclDrilling drilling{hole_in(*drilled, "femur", how), hole_in(*drilled, "tibia", how)};
  if (!drilling.femur && !drilling.tibia)
    return fail("has no round hole of 4 to 14 mm in femur or tibia", command.drilled,
                "Holes that a hand drilled may need a larger --roundness");
  return drilling;
}

Result<AclDrilling> drilling_of(const AclCommand& command) {
  if (!command.drilled.empty()) return holes_in(command);
  const auto femur =
      line_between(command.femur_from, command.femur_to, command.diameter_mm, "femur");
  if (!femur) return tl::unexpected(femur.error());
  const auto tibia =
      line_between(command.tibia_from, command.tibia_to, command.diameter_mm, "tibia");
  if (!tibia) return tl::unexpected(tibia.error());
  if (!*femur && !*tibia)
    return fail("no tunnel is given", "case acl",
                "Give --drilled CASE, or a line through femur or tibia");
  return AclDrilling{*femur, *tibia};
}

int run_acl_measure(const AclCommand& command) {
  const auto drilling = drilling_of(command);
  if (!drilling) return report_error(drilling.error());
  const auto def = open_case_def(command.spec);
  if (!def) return report_error(def.error());
  const auto report = make_acl_report(*def, *drilling);
  if (!report) return report_error(report.error());
  const std::string text = command.json ? to_json(*report).dump(2) + "\n" : to_text(*report);
  std::fputs(text.c_str(), stdout);
  return kExitDone;
}

}  // namespace

void add_case_acl_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<AclCommand>();
  cli::App* acl = app.get_subcommand("case")->add_subcommand(
      "acl",
      "Measure the tunnels of an ACL reconstruction: position, length, back wall, roof, and the "
      "knee's behaviour with a graft between them");
  acl->add_option("case", command->spec, "the knee before drilling, grown, or builtin:knee")
      ->required();
  acl->add_option("--drilled", command->drilled, "the same case drilled: its holes are measured");
  acl->add_option("--femur-from", command->femur_from,
                  "x,y,z in mm, World: start of a drill line, instead of --drilled");
  acl->add_option("--femur-to", command->femur_to, "x,y,z in mm, World: end of the drill line");
  acl->add_option("--tibia-from", command->tibia_from, "x,y,z in mm, World");
  acl->add_option("--tibia-to", command->tibia_to, "x,y,z in mm, World");
  acl->add_option("--diameter", command->diameter_mm, "diameter of a given drill line, mm")
      ->check(cli::Range(1.0, 20.0))
      ->capture_default_str();
  acl->add_option("--roundness", command->roundness_mm,
                  "greatest distance of a hole's wall from its cylinder, mm")
      ->check(cli::Range(0.001, 1.0))
      ->capture_default_str();
  acl->add_flag("--json", command->json, "print JSON");
  acl->callback([command, &exit_code] { exit_code = run_acl_measure(*command); });
}

}  // namespace osteon
