#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include "commands/support/parser.h"

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/seat_files.h"
#include "osteon/base/file.h"
#include "osteon/results/cmi5_course.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

using ScenarioJson = nlohmann::ordered_json;

struct ScenarioCommand {
  std::string scenario, case_spec;
  bool json = false, course = false;
};

struct CourseCommand {
  std::vector<std::string> names;
  std::string id, title = "Osteon", out;
  std::optional<std::uint64_t> seed;
};

std::vector<std::string> stage_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const ScenarioStage& stage : scenario.stages) names.push_back(stage.name);
  return names;
}

std::vector<std::string> error_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const ScenarioError& error : scenario.errors) names.push_back(error.name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

ScenarioJson summary_json(const Scenario& scenario) {
  return {{"name", scenario.name},
          {"title", scenario.title},
          {"stages", stage_names(scenario)},
          {"errors", error_names(scenario)},
          {"surgeons", surgeons_of(scenario)}};
}

int list_scenarios(const ScenarioCommand& command) {
  const auto all = command.course ? set_exercises() : all_exercises();
  if (!all) return report_error(all.error());
  ScenarioJson json = ScenarioJson::array();
  if (!command.json && !all->title.empty()) std::printf("%s\n", all->title.c_str());
  for (std::size_t i = 0; i < all->scenarios.size(); ++i) {
    const Scenario& scenario = all->scenarios[i];
    json.push_back(summary_json(scenario));
    if (all->seeds[i]) json.back()["seed"] = *all->seeds[i];
    if (!command.json)
      std::printf("%-16s %s (%zu stages, %zu errors)%s\n", scenario.name.c_str(),
                  scenario.title.c_str(), scenario.stages.size(), scenario.errors.size(),
                  all->seeds[i] ? (", patient " + std::to_string(*all->seeds[i])).c_str() : "");
  }
  if (command.json) std::printf("%s\n", json.dump(2).c_str());
  for (const Error& fault : all->faults) report_error(fault);
  return all->faults.empty() ? kExitDone : kExitNo;
}

ScenarioJson info_json(const Scenario& scenario) {
  ScenarioJson json = summary_json(scenario);
  json["text"] = scenario.text;
  json["version"] = scenario.version;
  json["anatomy"] = scenario.anatomy;
  json["time_limit_s"] = scenario.time_limit_s;
  json["instructions"] = ScenarioJson::object();
  for (const ScenarioStage& stage : scenario.stages)
    json["instructions"][stage.name] = stage.instruction;
  json["error_details"] = ScenarioJson::array();
  for (const ScenarioError& error : scenario.errors)
    json["error_details"].push_back({{"name", error.name},
                                     {"title", error.title},
                                     {"severity", to_text(error.severity)},
                                     {"consequence", error.consequence},
                                     {"rule", error.rule.kind},
                                     {"limits", error.rule.numbers},
                                     {"source", error.source}});
  json["metrics"] = ScenarioJson::array();
  for (const ScenarioMetric& metric : scenario.metrics)
    json["metrics"].push_back({{"name", metric.name},
                               {"unit", metric.unit},
                               {"weight", metric.weight},
                               {"better", metric.lower_is_better ? "lower" : "higher"},
                               {"threshold", metric.threshold},
                               {"source", metric.source}});
  return json;
}

void print_info(const Scenario& scenario) {
  std::printf("%s: %s\n%s\n\n", scenario.name.c_str(), scenario.title.c_str(),
              scenario.text.c_str());
  for (const ScenarioStage& stage : scenario.stages)
    std::printf("stage %s: %s\n  %s\n", stage.name.c_str(), stage.title.c_str(),
                stage.instruction.c_str());
  for (const ScenarioError& error : scenario.errors)
    std::printf("error %s (%s): %s. %s Source: %s\n", error.name.c_str(),
                std::string(to_text(error.severity)).c_str(), error.title.c_str(),
                error.consequence.c_str(), error.source.c_str());
  std::printf("surgeons: %s\n", listed(surgeons_of(scenario)).c_str());
}

ScenarioJson standard_json(const Standard& standard) {
  return {{"version", standard.version},
          {"source", standard.source},
          {"experts", standard.experts},
          {"pass_score", standard.pass_score},
          {"reliability", standard.reliability}};
}

int show_scenario(const ScenarioCommand& command) {
  const auto scenario = open_scenario(command.scenario);
  if (!scenario) return report_error(scenario.error());
  const auto standard = standard_in_use(scenario->name);
  if (!standard) return report_error(standard.error());
  if (command.json) {
    ScenarioJson json = info_json(*scenario);
    json["standard"] = *standard ? standard_json(**standard) : ScenarioJson(nullptr);
    std::printf("%s\n", json.dump(2).c_str());
    return kExitDone;
  }
  print_info(*scenario);
  if (*standard)
    std::printf("standard: version %d, %.4g to pass. Source: %s\n", (*standard)->version,
                (*standard)->pass_score, (*standard)->source.c_str());
  return kExitDone;
}

// Which bones and landmarks there are does not depend on what is felt: hulls cost nothing.
Result<std::string> with_hulls(const std::string& spec) {
  auto choice = parse_felt_choice(spec);
  if (!choice) return tl::unexpected(choice.error());
  choice->of_bone = {{std::string(), Felt::kHull}};
  choice->near_mm = 0;
  return to_text(*choice);
}

// What is soft, or lies under a mark that is to be felt, is not known without the soft parts.
bool needs_softs(const Scenario& scenario) {
  const auto is_felt = [](const Rule& goal) { return goal.kind == "felt"; };
  return !scenario.soft.empty() ||
         std::any_of(scenario.stages.begin(), scenario.stages.end(), [&](const ScenarioStage& s) {
           return std::any_of(s.goals.begin(), s.goals.end(), is_felt);
         });
}

int check_one(const ScenarioCommand& command) {
  const auto scenario = open_scenario(command.scenario);
  if (!scenario) return report_error(scenario.error());
  auto spec = Result<std::string>(command.case_spec);
  if (command.case_spec.empty()) spec = with_hulls(case_spec_of(*scenario, "", {}));
  if (!spec) return report_error(spec.error());
  const auto the_case =
      open_case(*spec, {}, needs_softs(*scenario) ? CaseParts::kAll : CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  auto lines = check_scenario(*scenario, **the_case);
  SessionSettings settings;
  settings.soft = scenario->soft;
  if (const auto softs = softs_for(**the_case, settings); !softs)
    lines.push_back(scenario->where + ": 'soft': " + softs.error().message());
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  if (lines.empty()) std::printf("sound\n");
  return lines.empty() ? kExitDone : kExitNo;
}

// A launch names a bundled exercise, so a course holds no others.
Result<Cmi5Course> course_of(const CourseCommand& command) {
  const auto all = shipped_scenarios();
  if (!all) return tl::unexpected(all.error());
  Cmi5Course course{command.id,
                    command.title,
                    "Exercises of Osteon",
                    command.seed ? std::to_string(*command.seed) : "",
                    {}};
  const auto add = [&course](const Scenario& scenario) -> Result<void> {
    const auto standard = standard_in_use(scenario.name);
    if (!standard) return tl::unexpected(standard.error());
    Cmi5Unit unit{scenario.name, scenario.title, scenario.text, {}};
    if (*standard) unit.mastery = (*standard)->pass_score / 100;
    course.units.push_back(std::move(unit));
    return {};
  };
  if (command.names.empty())
    for (const Scenario& scenario : *all)
      if (auto added = add(scenario); !added) return tl::unexpected(added.error());
  for (const std::string& name : command.names) {
    const auto named = std::find_if(
        all->begin(), all->end(), [&](const Scenario& scenario) { return scenario.name == name; });
    if (named == all->end())
      return fail("there is no exercise '" + name + "'", "course", "See: osteon scenario list");
    if (auto added = add(*named); !added) return tl::unexpected(added.error());
  }
  return course;
}

int write_course(const CourseCommand& command) {
  const auto course = course_of(command);
  if (!course) return report_error(course.error());
  const auto xml = cmi5_course_xml(*course);
  if (!xml) return report_error(xml.error());
  if (auto written = write_file_atomic(command.out, *xml); !written)
    return report_error(written.error());
  std::printf("%zu %s -> %s\n", course->units.size(),
              course->units.size() == 1 ? "exercise" : "exercises", command.out.c_str());
  return kExitDone;
}

void add_course_command(cli::App* group, int& exit_code) {
  auto order = std::make_shared<CourseCommand>();
  cli::App* course = group->add_subcommand(
      "course",
      "Write the course structure (cmi5.xml) that a learning management system imports. Each\n"
      "exercise becomes a unit that the system launches; see: osteon launch --help");
  course->add_option("scenario", order->names, "bundled exercises in their order; default: all");
  course
      ->add_option("--id", order->id,
                   "the course's own address, such as https://school.example/osteon")
      ->required();
  course->add_option("--title", order->title, "title of the course; default: Osteon");
  course->add_option("--seed", order->seed,
                     "seed of a random patient, the same for every unit; default: the patient that "
                     "the exercise describes");
  course->add_option("--out", order->out, "file to write, cmi5.xml")->required();
  course->callback([order, &exit_code] { exit_code = write_course(*order); });
}

}  // namespace

void add_scenario_commands(cli::App& app, int& exit_code) {
  cli::App* group = app.add_subcommand("scenario", "List, explain and check exercises");
  group->require_subcommand(1);
  auto options = std::make_shared<ScenarioCommand>();
  cli::App* list = group->add_subcommand("list", "List the bundled exercises");
  list->add_flag("--json", options->json, "print JSON");
  list->add_flag("--course", options->course,
                 "only the exercises that are set on this seat, in their order");
  list->callback([options, &exit_code] { exit_code = list_scenarios(*options); });
  cli::App* info = group->add_subcommand("info", "Show one exercise: stages, errors, metrics");
  info->add_option("scenario", options->scenario, "name or file")->required();
  info->add_flag("--json", options->json, "print JSON");
  info->callback([options, &exit_code] { exit_code = show_scenario(*options); });
  cli::App* check = group->add_subcommand(
      "check",
      "Check a scenario for mistakes, such as a rule that can never be met or a duplicate name.\n"
      "Exit code: 0 sound, 1 not, 2 cannot be read");
  check->add_option("scenario", options->scenario, "file or name")->required();
  check->add_option("--case", options->case_spec,
                    "case to check it on; default: the built-in one of its anatomy");
  check->callback([options, &exit_code] { exit_code = check_one(*options); });
  add_course_command(group, exit_code);
}

}  // namespace osteon
