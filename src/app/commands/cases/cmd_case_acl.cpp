#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_bone.h"
#include "cases/open_case.h"
#include "commands/cases/cmd_case_laxity.h"
#include "commands/support/cli_support.h"
#include "commands/support/parser.h"
#include "osteon/base/file.h"
#include "runs/reports/acl_report.h"
#include "runs/reports/drilled_bone.h"
#include "runs/reports/graft_report.h"

namespace osteon {
namespace {

struct AclCommand {
  std::string spec, drilled;
  std::string femur_from, femur_to, tibia_from, tibia_to;
  double diameter_mm = 8, roundness_mm = 0.3;
  bool json = false;
  std::string graft_file, screw;
  std::optional<double> graft_diameter_mm, graft_length_mm, loop_mm, tension_n, tension_flexion_deg;
  std::optional<double> divergence_deg, button_gap_mm, pretension_s, cycles;
  std::optional<double> passing_flexion_deg, tail_n;
};

std::optional<double> in_metres(const std::optional<double>& mm) {
  return mm ? std::optional<double>(*mm / 1000) : std::nullopt;
}

// "9x28": its diameter and length in mm.
Result<void> read_screw(const std::string& text, GraftChoices& choices) {
  double wide = 0, length = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lfx%lf%c", &wide, &length, &rest) != 2)
    return fail("'" + text + "' is not a screw", "--screw",
                "Give diameter and length in mm, like 9x28");
  choices.screw_m = wide / 1000;
  choices.screw_length_m = length / 1000;
  return {};
}

// None: nothing is said of the graft.
Result<std::optional<GraftChoices>> choices_of(const AclCommand& c) {
  const bool any = !c.graft_file.empty() || !c.screw.empty() || c.graft_diameter_mm ||
                   c.graft_length_mm || c.loop_mm || c.tension_n || c.tension_flexion_deg ||
                   c.divergence_deg || c.button_gap_mm || c.pretension_s || c.cycles ||
                   c.passing_flexion_deg || c.tail_n;
  if (!any) return std::optional<GraftChoices>();
  GraftChoices choices;
  if (!c.graft_file.empty()) {
    const auto text = read_file(c.graft_file, 16u << 20);
    if (!text) return tl::unexpected(text.error());
    const auto made = made_graft(*text, c.graft_file);
    if (!made) return tl::unexpected(made.error());
    choices.diameter_m = made->diameter_m;
    choices.length_m = made->length_m;
    choices.loop_m = made->loop_m;
    choices.pretension_s = made->creep_s;
  }
  if (c.graft_diameter_mm) choices.diameter_m = in_metres(c.graft_diameter_mm);
  if (c.graft_length_mm) choices.length_m = in_metres(c.graft_length_mm);
  if (c.loop_mm) choices.loop_m = in_metres(c.loop_mm);
  choices.tension_n = c.tension_n;
  choices.flexion_deg = c.tension_flexion_deg;
  choices.divergence_rad = c.divergence_deg.value_or(0) * std::numbers::pi / 180;
  choices.button_gap_m = c.button_gap_mm.value_or(0) / 1000;
  choices.pretension_s = c.pretension_s.value_or(choices.pretension_s);
  choices.cycles = c.cycles.value_or(choices.cycles);
  choices.passing_flexion_deg = c.passing_flexion_deg.value_or(choices.passing_flexion_deg);
  choices.tail_n = c.tail_n.value_or(choices.tail_n);
  if (!c.screw.empty())
    if (auto ok = read_screw(c.screw, choices); !ok) return tl::unexpected(ok.error());
  return std::optional<GraftChoices>(choices);
}

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

// Of the holes of a bone that a graft fits in the one that holds most.
std::optional<DrilledLine> hole_in(const CaseDef& drilled, const char* name, double roundness_m) {
  for (const BoneDef& bone : drilled.bones) {
    if (bone.name != name) continue;
    const auto holes = holes_of(bone.mesh, roundness_m);
    if (holes.empty()) return std::nullopt;
    const DrilledLine& most = holes.front();
    return DrilledLine{bone.X_WB * most.from_W, bone.X_WB * most.to_W, most.diameter_m};
  }
  return std::nullopt;
}

Result<AclDrilling> holes_in(const AclCommand& command) {
  const auto drilled = open_case_def(command.drilled, {}, CaseParts::kFelt);
  if (!drilled) return tl::unexpected(drilled.error());
  const double roundness_m = command.roundness_mm / 1000;
  AclDrilling drilling{hole_in(*drilled, "femur", roundness_m),
                       hole_in(*drilled, "tibia", roundness_m)};
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
  const auto choices = choices_of(command);
  if (!choices) return report_error(choices.error());
  const auto def = open_case_def(command.spec);
  if (!def) return report_error(def.error());
  const auto report = make_acl_report(*def, *drilling, *choices);
  if (!report) return report_error(report.error());
  const std::string text = command.json ? to_json(*report).dump(2) + "\n" : to_text(*report);
  std::fputs(text.c_str(), stdout);
  return kExitDone;
}

void add_acl_graft_options(cli::App& acl, AclCommand& c) {
  const auto number = [&](const char* name, std::optional<double>& into, const char* text,
                          double least, double most) {
    acl.add_option(name, into, text)->check(cli::Range(least, most));
  };
  acl.add_option(
      "--graft", c.graft_file,
      "report of a run of acl_graft: diameter, length, loop and pretension of its graft");
  number("--graft-diameter", c.graft_diameter_mm,
         "diameter of the graft, mm; default: that of the thinner tunnel", 4, 14);
  number("--graft-length", c.graft_length_mm,
         "length of the folded graft, mm; default: long enough for both tunnels", 5, 300);
  number("--loop", c.loop_mm,
         "length of the button's loop, mm; default: the shortest that lets the button turn", 5, 60);
  number("--passing-flexion", c.passing_flexion_deg,
         "flexion while the graft is drawn in, degrees; default: 90", 0, 130);
  number("--tail", c.tail_n, "pull on the graft's tail while it is drawn in, N; default: 10", 0,
         200);
  number("--tension", c.tension_n, "tension while the graft is fixed, N; default: 90", 1, 500);
  number("--tension-flexion", c.tension_flexion_deg,
         "flexion while the graft is fixed, degrees; default: 30", 0, 130);
  number("--pretension", c.pretension_s,
         "how long the bench stretched the graft with 80 N, s; default: 600", 0, 1e6);
  number("--cycles", c.cycles, "how often the knee is bent before the screw goes in; default: 25",
         0, 1e5);
  acl.add_option(
      "--screw", c.screw,
      "DIAMETERxLENGTH of the interference screw, mm; default: the tunnel's diameter + 1, and 28");
  number("--screw-divergence", c.divergence_deg,
         "angle between screw and tunnel, degrees; default: 0", 0, 60);
  number("--button-gap", c.button_gap_mm,
         "thickness of the soft tissue under the button, mm; default: 0", 0, 30);
}

}  // namespace

void add_case_acl_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<AclCommand>();
  cli::App* acl = app.get_subcommand("case")->add_subcommand(
      "acl",
      "Measure the tunnels of an ACL reconstruction: position, length, back wall, roof, and the "
      "knee's behaviour with a graft between them");
  acl->add_option("case", command->spec,
                  "the knee before drilling: the case folder of a generated knee, or builtin:knee")
      ->required();
  acl->add_option("--drilled", command->drilled,
                  "the same case after drilling; its holes are measured");
  acl->add_option(
      "--femur-from", command->femur_from,
      "x,y,z in mm, World: start of the line of the femur's drill, instead of --drilled");
  acl->add_option("--femur-to", command->femur_to, "x,y,z in mm, World: end of that line");
  acl->add_option("--tibia-from", command->tibia_from,
                  "x,y,z in mm, World: start of the line of the tibia's drill");
  acl->add_option("--tibia-to", command->tibia_to, "x,y,z in mm, World: end of that line");
  acl->add_option("--diameter", command->diameter_mm, "diameter of the drill along such a line, mm")
      ->check(cli::Range(1.0, 20.0))
      ->capture_default_str();
  acl->add_option("--roundness", command->roundness_mm,
                  "greatest distance of a hole's wall from its cylinder, mm")
      ->check(cli::Range(0.001, 1.0))
      ->capture_default_str();
  add_acl_graft_options(*acl, *command);
  acl->add_flag("--json", command->json, "print JSON");
  acl->callback([command, &exit_code] { exit_code = run_acl_measure(*command); });
  add_case_acl_faults_command(app, exit_code);
}

}  // namespace osteon
