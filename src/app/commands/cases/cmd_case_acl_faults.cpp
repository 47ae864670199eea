// What classic faults of a reconstruction cost, over several random knees.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "commands/cases/cmd_case_laxity.h"
#include "commands/support/cli_support.h"
#include "commands/support/parser.h"
#include "osteon/surgeon/acl_plan.h"
#include "runs/reports/acl_report.h"

namespace osteon {
namespace {

using FaultJson = nlohmann::ordered_json;

constexpr double kReamed_m = 0.008, kSocket_m = 0.025, kOut_m = 0.002, kThrough_m = 0.075;

struct FaultsCommand {
  int knees = 5;
  bool json = false;
};

// One way to reconstruct: where the tunnels are, and how the graft is fixed in them.
struct FaultRow {
  const char* name;
  const char* tunnels;
  GraftChoices choices;
};

std::vector<FaultRow> fault_rows() {
  std::vector<FaultRow> rows{{"none", "", {}},
                             {"vertical_femur", "vertical_femur", {}},
                             {"anterior_tibia", "anterior_tibia", {}},
                             {"divergent_screw", "", {}},
                             {"slack_graft", "", {}},
                             {"button_gap", "", {}},
                             {"unflipped_button", "", {}},
                             {"amputated_tendon", "", {}}};
  rows[3].choices.divergence_rad = 30 * std::numbers::pi / 180;
  rows[4].choices.pretension_s = 0;
  rows[4].choices.cycles = 0;
  rows[4].choices.tension_n = 20;
  rows[5].choices.button_gap_m = 0.003;
  rows[6].choices.loop_m = 0.008;
  rows[7].choices.length_m = 0.050;
  return rows;
}

struct FaultFound {
  double excursion_mm = 0, lachman_mm = 0, ahead_mm = 0, pivot_mm = 0, turn_deg = 0, roof_mm = 0;
  bool holds = true;
};

// What is measured of each reconstruction.
struct FaultMeasure {
  const char* key;    // of the JSON
  const char* title;  // of the printed columns
  double FaultFound::*value;
};
constexpr FaultMeasure kFaultMeasures[] = {
    {"lachman_difference_mm", "Lachman", &FaultFound::lachman_mm},
    {"lachman_ahead_mm", "ahead", &FaultFound::ahead_mm},
    {"pivot_difference_mm", "pivot", &FaultFound::pivot_mm},
    {"pivot_rotation_deg", "turn", &FaultFound::turn_deg},
    {"graft_excursion_mm", "length", &FaultFound::excursion_mm},
    {"roof_gap_mm", "roof", &FaultFound::roof_mm}};

// The case's bones where they are at rest with the knee straight.
Pose bone_pose(const CaseDef& def, const char* name) {
  for (const BoneDef& bone : def.bones)
    if (bone.name == name) return bone.X_WB;
  return {};
}

AclDrilling drilling_of(const CaseDef& straight, const AclPlan& plan) {
  const Pose X_WF = bone_pose(straight, "femur"), X_WT = bone_pose(straight, "tibia");
  const auto line = [](const Pose& X, const Vec3& at, const Vec3& in, double deep_m) {
    return DrilledLine{X * Vec3(at - kOut_m * in), X * Vec3(at + deep_m * in), kReamed_m};
  };
  return {line(X_WF, plan.femur_B, plan.femur_in_B, kSocket_m),
          line(X_WT, plan.tibia_B, plan.tibia_in_B, kThrough_m)};
}

Result<FaultFound> reconstruct(const CaseDef& straight, const Case& bent, const FaultRow& row) {
  const auto plan = plan_tunnels(bent, row.tunnels, kReamed_m, true);
  if (!plan) return tl::unexpected(plan.error());
  const auto report = make_acl_report(straight, drilling_of(straight, *plan), row.choices);
  if (!report) return tl::unexpected(report.error());
  if (!report->graft) return fail("a tunnel is missing", row.name);
  const GraftOutcome& graft = *report->graft;
  FaultFound out;
  out.excursion_mm = 1e3 * graft.excursion_m;
  out.lachman_mm = 1e3 * (graft.lachman.anterior_m - graft.lachman_whole_m);
  out.ahead_mm = 1e3 * graft.lachman_ahead_m;
  out.pivot_mm = 1e3 * (graft.pivot.anterior_m - graft.pivot_whole_m);
  out.turn_deg = 180 / std::numbers::pi * graft.pivot.internal_rad;
  out.roof_mm = 1e3 * graft.roof_gap_m;
  out.holds = graft.holds;
  return out;
}

struct Spread {
  double least = 0, middle = 0, most = 0;
};

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

struct FaultSum {
  const char* name;
  std::vector<FaultFound> found;
};

Spread spread_of(const FaultSum& sum, const FaultMeasure& measure) {
  std::vector<double> values;
  for (const FaultFound& one : sum.found) values.push_back(one.*measure.value);
  return spread_of(std::move(values));
}

// Whether no knee with the fault measures as any knee without it.
bool is_outside(const FaultSum& fault, const FaultSum& good, const FaultMeasure& measure) {
  if (fault.found.empty() || good.found.empty() || &fault == &good) return false;
  const Spread has = spread_of(fault, measure), wanted = spread_of(good, measure);
  return has.least > wanted.most || has.most < wanted.least;
}

std::string sums_json(const std::vector<FaultSum>& sums) {
  FaultJson rows = FaultJson::array();
  for (const FaultSum& sum : sums) {
    const auto held = std::count_if(sum.found.begin(), sum.found.end(),
                                    [](const FaultFound& one) { return one.holds; });
    FaultJson row{{"fault", sum.name}, {"knees", sum.found.size()}, {"holds", held}};
    FaultJson outside = FaultJson::array();
    for (const FaultMeasure& measure : kFaultMeasures) {
      const Spread s = spread_of(sum, measure);
      row[measure.key] = {{"least", s.least}, {"median", s.middle}, {"most", s.most}};
      if (is_outside(sum, sums.front(), measure)) outside.push_back(measure.key);
    }
    row["outside_good"] = std::move(outside);
    rows.push_back(std::move(row));
  }
  return rows.dump(2) + "\n";
}

std::string sums_text(const std::vector<FaultSum>& sums) {
  std::string text =
      "least, median, most over the knees, mm: Lachman more than the intact knee; tibia ahead of "
      "the intact knee's; pivot more than the intact knee; inward turn in the pivot, degrees; "
      "change of the graft's length; space under the roof. *: no knee with this fault measures as "
      "any without one\n";
  char line[80];
  const auto add = [&](const char* form, auto... values) {
    std::snprintf(line, sizeof line, form, values...);
    text += line;
  };
  add("%-18s", "");
  for (const FaultMeasure& measure : kFaultMeasures) add("%20s", measure.title);
  text += "\n";
  for (const FaultSum& sum : sums) {
    add("%-18s", sum.name);
    for (const FaultMeasure& measure : kFaultMeasures) {
      const Spread s = spread_of(sum, measure);
      add(" %5.1f %5.1f %5.1f%s", s.least, s.middle, s.most,
          is_outside(sum, sums.front(), measure) ? "*" : " ");
    }
    text += "\n";
  }
  return text;
}

int run_faults(const FaultsCommand& command) {
  std::vector<FaultSum> sums;
  for (const FaultRow& row : fault_rows()) sums.push_back({row.name, {}});
  for (int seed = 0; seed < command.knees; ++seed) {
    const std::string spec = "builtin:knee:" + std::to_string(seed) + ":acl_tear=midsubstance";
    const auto straight = open_case_def(spec);
    if (!straight) return report_error(straight.error());
    const auto bent = open_felt_case(spec + "#hull,flexion=120");
    if (!bent) return report_error(bent.error());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto found = reconstruct(*straight, **bent, fault_rows()[i]);
      if (found)
        sums[i].found.push_back(*found);
      else
        std::fprintf(stderr, "osteon: knee %d, %s: %s\n", seed, sums[i].name,
                     found.error().message().c_str());
    }
  }
  std::fputs((command.json ? sums_json(sums) : sums_text(sums)).c_str(), stdout);
  return kExitDone;
}

}  // namespace

void add_case_acl_faults_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<FaultsCommand>();
  cli::App* faults = app.get_subcommand("case")->add_subcommand(
      "acl-faults",
      "Show what classic faults of an ACL reconstruction do: laxity and isometry of random knees "
      "in which the virtual surgeon has placed the tunnels");
  faults->add_option("--knees", command->knees, "how many random knees, seeds from 0")
      ->check(cli::Range(1, 100))
      ->capture_default_str();
  faults->add_flag("--json", command->json, "print JSON");
  faults->callback([command, &exit_code] { exit_code = run_faults(*command); });
}

}  // namespace osteon
