#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/parser.h"
#include "commands/result_sending.h"
#include "exercises/result_files.h"
#include "osteon/base/file.h"
#include "osteon/procedure/lc_cusum.h"
#include "osteon/results/exports.h"
#include "osteon/results/names.h"

namespace osteon {
namespace {

struct ResultsCommand {
  std::string id, learner, name, scenario, format, out;
  LcCusumOptions cusum;
  bool json = false;
};

Result<std::vector<AttemptRow>> wanted_rows(const ResultsCommand& command) {
  const auto store = open_results();
  if (!store) return tl::unexpected(store.error());
  return store->list({command.learner, command.scenario});
}

nlohmann::ordered_json row_json(const AttemptRow& row) {
  auto json = nlohmann::ordered_json::parse(to_json(row));
  json.erase("report");
  return json;
}

int list_results(const ResultsCommand& command) {
  const auto rows = wanted_rows(command);
  if (!rows) return report_error(rows.error());
  const auto names = load_names(names_file());
  if (!names) return report_error(names.error());
  auto json = nlohmann::ordered_json::array();
  for (const AttemptRow& row : *rows) {
    json.push_back(row_json(row));
    if (command.json) continue;
    const auto name = names->find(row.learner);
    std::printf("%s  %-12s %-14s %-10s %s%s\n", row.id.c_str(), row.learner.c_str(),
                row.scenario.c_str(), row.verdict.c_str(),
                row.score ? std::to_string(*row.score).c_str() : "-",
                name == names->end() ? "" : ("  " + name->second).c_str());
  }
  if (command.json)
    std::printf("%s\n", json.dump(2).c_str());
  else if (rows->empty())
    std::printf("no attempts\n");
  return kExitDone;
}

int show_result(const ResultsCommand& command) {
  const auto store = open_results();
  if (!store) return report_error(store.error());
  const auto row = store->find(command.id);
  if (!row) return report_error(row.error());
  if (!*row)
    return report_error({"there is no attempt '" + command.id + "'",
                         without_password(results_place()), "See: osteon results list"});
  auto json = row_json(**row);
  json["report"] = nlohmann::ordered_json::parse((*row)->report_json);
  std::printf("%s\n", json.dump(2).c_str());
  return kExitDone;
}

// One learner's attempts at one scenario, in order.
nlohmann::ordered_json curve_json(const std::vector<AttemptRow>& rows,
                                  const LcCusumOptions& options) {
  std::vector<bool> passed;
  auto scores = nlohmann::ordered_json::array();
  for (const AttemptRow& row : rows) {
    passed.push_back(row.verdict == "passed");
    scores.push_back(row.score ? nlohmann::ordered_json(*row.score)
                               : nlohmann::ordered_json(nullptr));
  }
  const LcCusum curve = lc_cusum(passed, options);
  return {{"learner", rows[0].learner},
          {"scenario", rows[0].scenario},
          {"attempts", rows.size()},
          {"passed", passed},
          {"scores", scores},
          {"lc_cusum", curve.s},
          {"limit", options.h},
          {"competent_at", curve.competent_at},
          {"relapse_at", curve.relapse_at}};
}

int show_curves(const ResultsCommand& command) {
  const auto rows = wanted_rows(command);
  if (!rows) return report_error(rows.error());
  std::map<std::pair<std::string, std::string>, std::vector<AttemptRow>> groups;
  for (const AttemptRow& row : *rows) groups[{row.learner, row.scenario}].push_back(row);
  auto all = nlohmann::ordered_json::array();
  for (const auto& [key, group] : groups) {
    const auto curve = curve_json(group, command.cusum);
    all.push_back(curve);
    if (command.json) continue;
    const int competent = curve["competent_at"], relapse = curve["relapse_at"];
    std::printf(
        "%s, %s: %zu attempts, S = %.2f of %.2f, %s%s\n", key.first.c_str(), key.second.c_str(),
        group.size(), curve["lc_cusum"].back().get<double>(), command.cusum.h,
        competent < 0 ? "not yet competent"
                      : ("competent since attempt " + std::to_string(competent + 1)).c_str(),
        relapse < 0 ? "" : "; RELAPSE: has failed too often since");
  }
  if (command.json) std::printf("%s\n", all.dump(2).c_str());
  if (!command.json && groups.empty()) std::printf("no attempts\n");
  return kExitDone;
}

int forget_learner(const ResultsCommand& command) {
  auto store = open_results();
  if (!store) return report_error(store.error());
  const auto gone = store->forget(command.learner);
  if (!gone) return report_error(gone.error());
  auto names = load_names(names_file());
  if (!names) return report_error(names.error());
  if (names->erase(command.learner) > 0)
    if (auto ok = save_names(*names, names_file()); !ok) return report_error(ok.error());
  std::printf("%d attempts of %s deleted\n", *gone, command.learner.c_str());
  return kExitDone;
}

int name_learner(const ResultsCommand& command) {
  if (!is_learner_id(command.learner))
    return report_error({"'" + command.learner + "' is not a valid learner's id", "--learner",
                         "Use 1 to 64 letters, digits, '.', '_' and '-'"});
  auto names = load_names(names_file());
  if (!names) return report_error(names.error());
  (*names)[command.learner] = command.name;
  if (auto ok = save_names(*names, names_file()); !ok) return report_error(ok.error());
  return kExitDone;
}

int export_results(const ResultsCommand& command) {
  const auto rows = wanted_rows(command);
  if (!rows) return report_error(rows.error());
  const Result<void> done = command.format == "csv" ? write_file_atomic(command.out, to_csv(*rows))
                            : command.format == "xapi"
                                ? write_file_atomic(command.out, to_xapi(*rows))
                                : save_results_pdf(*rows, command.out);
  if (!done) return report_error(done.error());
  std::printf("%zu attempts written to %s\n", rows->size(), command.out.c_str());
  return kExitDone;
}

void add_filter(cli::App& command, ResultsCommand& options) {
  command.add_option("--learner", options.learner, "only those of this learner");
  command.add_option("--scenario", options.scenario, "only those of this scenario");
}

}  // namespace

void add_results_commands(cli::App& app, int& exit_code) {
  auto options = std::make_shared<ResultsCommand>();
  cli::App* group =
      app.add_subcommand("results", "List and export stored attempts; print learning curves");
  group->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, int (*run)(const ResultsCommand&)) {
    cli::App* command = group->add_subcommand(name, text);
    command->callback([options, run, &exit_code] { exit_code = run(*options); });
    return command;
  };
  cli::App* list = add("list", "List all attempts, the oldest first", list_results);
  add_filter(*list, *options);
  list->add_flag("--json", options->json, "print JSON");
  add("show", "Show one attempt with its report, JSON", show_result)
      ->add_option("id", options->id, "its id, as `results list` prints it")
      ->required();
  cli::App* curve =
      add("curve", "Learning curves (LC-CUSUM) with warnings of relapse", show_curves);
  add_filter(*curve, *options);
  curve->add_flag("--json", options->json, "print JSON");
  curve->add_option("--p0", options->cusum.p0, "share of failures that is acceptable")
      ->check(cli::Range(0.001, 0.5))
      ->capture_default_str();
  curve->add_option("--d", options->cusum.d, "increase of that share that is unacceptable")
      ->check(cli::Range(0.001, 0.49))
      ->capture_default_str();
  curve->add_option("--limit", options->cusum.h, "S at which a learner is competent")
      ->check(cli::Range(0.01, 1000.0))
      ->capture_default_str();
  add("forget", "Delete all attempts and the name of a learner", forget_learner)
      ->add_option("--learner", options->learner, "the learner's id")
      ->required();
  cli::App* name =
      add("name", "Give a learner's id a name, stored on this computer only", name_learner);
  name->add_option("--learner", options->learner, "the learner's id")->required();
  name->add_option("--name", options->name, "the name")->required();
  cli::App* write = add("export", "Write attempts to a file", export_results);
  add_filter(*write, *options);
  write->add_option("--format", options->format, "csv, xapi or pdf")
      ->required()
      ->check(cli::IsMember({"csv", "xapi", "pdf"}));
  write->add_option("--out", options->out, "file to write")->required();
  add_result_sending(*group, exit_code);
  add_result_rescore(*group, exit_code);
}

}  // namespace osteon
