#include "commands/cases/cmd_case_laxity.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_bone.h"
#include "cases/open_case.h"
#include "commands/cases/cmd_case_laxity_report.h"
#include "commands/support/cli_support.h"
#include "commands/support/parser.h"
#include "osteon/base/file.h"
#include "osteon/physics/reference_knee.h"

namespace osteon {
namespace {

struct LaxityCommand {
  std::string spec, test = "all", reference;
  std::vector<std::string> without;
  std::optional<double> flexion_deg;
  bool graft = false;
  std::string graft_from, graft_to;
  std::optional<double> graft_tension_n, graft_flexion_deg, graft_diameter_mm;
  bool json = false;
};

struct IsometryCommand {
  std::string spec, from, to;
  bool json = false;
};

Result<LigamentTable> default_ligaments() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_ligament_table(*data / "assets/tissue/knee_ligaments.toml");
}

Result<std::optional<Vec3>> place_of(const std::string& text, const std::string& option) {
  if (text.empty()) return std::optional<Vec3>();
  const auto point = point_from_mm(text, option);
  if (!point) return tl::unexpected(point.error());
  return std::optional<Vec3>(*point);
}

Result<KneeChanges> changes_of(const LaxityCommand& command) {
  KneeChanges changes;
  changes.without = command.without;
  if (!command.graft) return changes;
  const auto from = place_of(command.graft_from, "--graft-from");
  if (!from) return tl::unexpected(from.error());
  const auto to = place_of(command.graft_to, "--graft-to");
  if (!to) return tl::unexpected(to.error());
  KneeGraft graft{*from, *to, {}, command.graft_tension_n, command.graft_flexion_deg};
  if (command.graft_diameter_mm) graft.diameter_m = *command.graft_diameter_mm / 1000;
  changes.graft = graft;
  return changes;
}

std::vector<LaxityTestRow> tests_of(const LigamentTable& table, const LaxityCommand& command) {
  std::vector<LaxityTestRow> tests;
  for (const LaxityTestRow& row : table.tests)
    if (command.test == "all" || command.test == row.name) tests.push_back(row);
  for (LaxityTestRow& test : tests)
    test.flexion_deg = command.flexion_deg.value_or(test.flexion_deg);
  return tests;
}

Result<std::vector<LaxityReport>> reports_of(const CaseDef& def, const LaxityCommand& command) {
  const auto table = default_ligaments();
  if (!table) return tl::unexpected(table.error());
  const auto changes = changes_of(command);
  if (!changes) return tl::unexpected(changes.error());
  const auto knee = make_knee(def, *table, *changes);
  if (!knee) return tl::unexpected(knee.error());
  KneeChanges healed;
  healed.heal = true;
  const auto whole = make_knee(def, *table, healed);
  if (!whole) return tl::unexpected(whole.error());
  std::vector<LaxityReport> reports;
  for (const LaxityTestRow& test : tests_of(*table, command)) {
    const auto found = test_laxity(*knee, test);
    if (!found) return tl::unexpected(found.error());
    const auto other = test_laxity(*whole, test);
    if (!other) return tl::unexpected(other.error());
    reports.push_back({test, *found, other->anterior_m});
  }
  return reports;
}

/// `make`: the knee without these ligaments.
template <class Make>
Result<LaxityBeside> beside(const std::string& name, const LaxityTestRow& test, const Make& make) {
  LaxityBeside row{name, 0, 0};
  for (const bool torn : {false, true}) {
    const auto knee = make(torn ? std::vector<std::string>{"acl"} : std::vector<std::string>{});
    if (!knee) return tl::unexpected(knee.error());
    const auto found = test_laxity(*knee, test);
    if (!found) return tl::unexpected(found.error());
    if (!found->converged) return fail("did not reach equilibrium", name);
    (torn ? row.without_acl_m : row.whole_m) = found->anterior_m;
  }
  return row;
}

/// The case beside the published knee, at the bend and load of what is published of that.
int run_beside(const LaxityCommand& command, const CaseDef& def) {
  const LaxityTestRow test{"reference", 25, 100, 0, 0};
  const auto table = default_ligaments();
  if (!table) return report_error(table.error());
  const auto ours = beside(def.name, test, [&](const std::vector<std::string>& without) {
    return make_knee(def, *table, {true, without, {}});
  });
  if (!ours) return report_error(ours.error());
  const auto theirs =
      beside("reference, solved here", test, [&](const std::vector<std::string>& without) {
        return load_reference_knee(command.reference, *table, without);
      });
  if (!theirs) return report_error(theirs.error());
  // From 1.2 to 7.1 mm and from 7.8 to 23.7 mm (OpenSim JAM).
  const std::vector<LaxityBeside> rows{*ours, *theirs, {"reference, published", 0.0059, 0.0159}};
  std::fputs((command.json ? beside_json(test, rows) : beside_text(test, rows)).c_str(), stdout);
  return kExitDone;
}

int run_laxity(const LaxityCommand& command) {
  const auto def = open_case_def(command.spec);
  if (!def) return report_error(def.error());
  if (!command.reference.empty()) return run_beside(command, *def);
  const auto reports = reports_of(*def, command);
  if (!reports) return report_error(reports.error());
  const std::string text =
      command.json ? laxity_json(def->name, def->side, *reports) : laxity_text(*reports);
  std::fputs(text.c_str(), stdout);
  const bool at_rest = std::all_of(reports->begin(), reports->end(),
                                   [](const LaxityReport& r) { return r.found.converged; });
  return at_rest ? kExitDone : kExitNo;
}

int run_isometry(const IsometryCommand& command) {
  const auto from_W = point_from_mm(command.from, "--from");
  if (!from_W) return report_error(from_W.error());
  const auto to_W = point_from_mm(command.to, "--to");
  if (!to_W) return report_error(to_W.error());
  const auto def = open_case_def(command.spec, {}, CaseParts::kFelt);
  if (!def) return report_error(def.error());
  const auto lengths = line_over_flexion(*def, *from_W, *to_W);
  if (!lengths) return report_error(lengths.error());
  std::fputs((command.json ? isometry_json(*lengths) : isometry_text(*lengths)).c_str(), stdout);
  return kExitDone;
}

void add_graft_options(cli::App& laxity, LaxityCommand& command) {
  cli::Option* graft = laxity.add_flag("--graft", command.graft, "replace the ACL by a graft");
  laxity
      .add_option("--graft-from", command.graft_from,
                  "graft's attachment on the femur: x,y,z in World, mm")
      ->needs(graft);
  laxity
      .add_option("--graft-to", command.graft_to,
                  "graft's attachment on the tibia: x,y,z in World, mm")
      ->needs(graft);
  laxity
      .add_option("--graft-tension", command.graft_tension_n,
                  "tension while the graft is fixed, N; default: 90")
      ->check(cli::Range(1.0, 500.0))
      ->needs(graft);
  laxity
      .add_option("--graft-flexion", command.graft_flexion_deg,
                  "flexion while the graft is fixed, degrees; default: 30")
      ->check(cli::Range(0.0, 130.0))
      ->needs(graft);
  laxity
      .add_option("--graft-diameter", command.graft_diameter_mm,
                  "diameter of the graft, mm; default: 8")
      ->check(cli::Range(1.0, 20.0))
      ->needs(graft);
}

void add_laxity(cli::App& group, int& exit_code) {
  auto command = std::make_shared<LaxityCommand>();
  cli::App* laxity =
      group.add_subcommand("laxity",
                           "Laxity of a knee in the manual stability tests, mm and degrees, and "
                           "the tension of its ligaments. Exits 1 when no equilibrium is found");
  laxity->add_option("case", command->spec, "case folder of a generated knee, or builtin:knee")
      ->required();
  laxity
      ->add_option("--test", command->test,
                   "lachman, drawer, pivot, varus, valgus or all; default: all")
      ->check(cli::IsMember({"lachman", "drawer", "pivot", "varus", "valgus", "all"}));
  laxity
      ->add_option("--flexion", command->flexion_deg,
                   "flexion during the test, degrees; default: each test's own")
      ->check(cli::Range(0.0, 130.0));
  laxity->add_option("--without", command->without,
                     "cut this ligament first; may be given several times");
  add_graft_options(*laxity, *command);
  laxity->add_option("--reference", command->reference,
                     "folder with the published knee: print both knees side by side instead");
  laxity->add_flag("--json", command->json, "print the result as JSON");
  laxity->callback([command, &exit_code] { exit_code = run_laxity(*command); });
}

}  // namespace

void add_case_laxity_commands(cli::App& app, int& exit_code) {
  cli::App* group = app.get_subcommand("case");
  add_laxity(*group, exit_code);
  auto command = std::make_shared<IsometryCommand>();
  cli::App* isometry = group->add_subcommand(
      "isometry", "How the length of a line from femur to tibia changes while the knee bends");
  isometry->add_option("case", command->spec, "case folder of a generated knee, or builtin:knee")
      ->required();
  isometry->add_option("--from", command->from, "end on the femur: x,y,z in World, mm")->required();
  isometry->add_option("--to", command->to, "end on the tibia: x,y,z in World, mm")->required();
  isometry->add_flag("--json", command->json, "print the result as JSON");
  isometry->callback([command, &exit_code] { exit_code = run_isometry(*command); });
  add_case_acl_command(app, exit_code);
}

}  // namespace osteon
