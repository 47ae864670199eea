#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/parser.h"
#include "commands/teaching/result_sending.h"
#include "exercises/result_files.h"
#include "osteon/base/file.h"
#include "osteon/procedure/lc_cusum.h"
#include "osteon/results/cohort.h"
#include "osteon/results/exports.h"
#include "osteon/results/names.h"

namespace osteon {
namespace {

struct ResultsCommand {
  std::string id, other, learner, name, scenario, format, out;
  LcCusumOptions cusum;
  bool json = false, names = false;
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

Result<AttemptRow> kept_attempt(const ResultStore& store, const std::string& id) {
  auto row = store.find(id);
  if (!row) return tl::unexpected(row.error());
  if (!*row)
    return fail("there is no attempt '" + id + "'", without_password(results_place()),
                "See: osteon results list");
  return std::move(**row);
}

int show_result(const ResultsCommand& command) {
  const auto store = open_results();
  if (!store) return report_error(store.error());
  const auto row = kept_attempt(*store, command.id);
  if (!row) return report_error(row.error());
  auto json = row_json(*row);
  json["report"] = nlohmann::ordered_json::parse(row->report_json);
  std::printf("%s\n", json.dump(2).c_str());
  return kExitDone;
}

// One learner's attempts at one scenario, in order.
nlohmann::ordered_json curve_json(const std::vector<AttemptRow>& rows,
                                  const LcCusumOptions& options) {
  std::vector<bool> passed, alone;
  std::vector<int> place;  // of those that count, among all
  auto scores = nlohmann::ordered_json::array();
  for (const AttemptRow& row : rows) {
    passed.push_back(row.verdict == "passed");
    if (!was_guided(row)) {
      alone.push_back(passed.back());
      place.push_back(static_cast<int>(passed.size()) - 1);
    }
    scores.push_back(row.score ? nlohmann::ordered_json(*row.score)
                               : nlohmann::ordered_json(nullptr));
  }
  const LcCusum curve = lc_cusum(alone, options);
  const auto in_all = [&](int at) { return at < 0 ? at : place[static_cast<std::size_t>(at)]; };
  return {{"learner", rows[0].learner},
          {"scenario", rows[0].scenario},
          {"attempts", rows.size()},
          {"passed", passed},
          {"scores", scores},
          {"guided", passed.size() - alone.size()},
          {"lc_cusum", curve.s},
          {"limit", options.h},
          {"competent_at", in_all(curve.competent_at)},
          {"relapse_at", in_all(curve.relapse_at)}};
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
        group.size(), curve["lc_cusum"].empty() ? 0 : curve["lc_cusum"].back().get<double>(),
        command.cusum.h,
        competent < 0 ? "not yet competent"
                      : ("competent since attempt " + std::to_string(competent + 1)).c_str(),
        relapse < 0 ? "" : "; RELAPSE: too many failures since then");
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

// A page of the whole class, HTML or PDF by the file's name.
int write_cohort(const ResultsCommand& command) {
  if (command.out.empty() && !command.json)
    return report_error({"no output is given", "--out",
                         "Give a file .html or .pdf, or --json to print its figures"});
  const bool html = command.out.ends_with(".html");
  if (!command.out.empty() && !html && !command.out.ends_with(".pdf"))
    return report_error(
        {"is neither .html nor .pdf", command.out, "Give a name that ends in .html or .pdf"});
  const auto rows = wanted_rows(command);
  if (!rows) return report_error(rows.error());
  const auto names = command.names ? load_names(names_file()) : LearnerNames();
  if (!names) return report_error(names.error());
  const Cohort cohort = cohort_of(*rows, command.cusum);
  if (!command.out.empty()) {
    const auto done = html ? write_file_atomic(command.out, to_html(cohort, *names))
                           : save_cohort_pdf(cohort, *names, command.out);
    if (!done) return report_error(done.error());
  }
  if (command.json)
    std::fputs(to_json(cohort).c_str(), stdout);
  else
    std::printf("%zu attempts at %zu exercises written to %s\n", rows->size(), cohort.size(),
                command.out.c_str());
  return kExitDone;
}

void say_compared(const nlohmann::ordered_json& json) {
  const auto head = [&](const char* which) {
    const auto& one = json[which];
    std::printf("%s  %s, %s: %s, score %s\n", which, one["learner"].get<std::string>().c_str(),
                one["scenario"].get<std::string>().c_str(),
                one["verdict"].get<std::string>().c_str(), one["score"].dump().c_str());
  };
  head("a");
  head("b");
  if (!json["same_scenario"])
    std::printf("the exercises differ, so the figures cannot be compared\n");
  for (const auto& stage : json["stages"])
    std::printf("stage   %-24s %10s %10s s\n", stage["name"].get<std::string>().c_str(),
                stage["a_s"].dump().c_str(), stage["b_s"].dump().c_str());
  for (const auto& metric : json["metrics"])
    std::printf("metric  %-24s %10s %10s\n", metric["name"].get<std::string>().c_str(),
                metric["a"].dump().c_str(), metric["b"].dump().c_str());
  for (const char* where : {"both", "only_a", "only_b"})
    for (const auto& error : json["errors"][where])
      std::printf("error   %-24s %s\n", error.get<std::string>().c_str(), where);
}

int compare_results(const ResultsCommand& command) {
  const auto store = open_results();
  if (!store) return report_error(store.error());
  const auto a = kept_attempt(*store, command.id), b = kept_attempt(*store, command.other);
  if (!a) return report_error(a.error());
  if (!b) return report_error(b.error());
  const auto compared = compare_attempts(*a, *b);
  if (!compared) return report_error(compared.error());
  if (command.json)
    std::fputs(compared->c_str(), stdout);
  else
    say_compared(nlohmann::ordered_json::parse(*compared));
  return kExitDone;
}

void add_filter(cli::App& command, ResultsCommand& options) {
  command.add_option("--learner", options.learner, "only those of this learner");
  command.add_option("--scenario", options.scenario, "only those of this scenario");
}

void add_cusum(cli::App& command, LcCusumOptions& cusum) {
  command.add_option("--p0", cusum.p0, "share of failures that is acceptable")
      ->check(cli::Range(0.001, 0.5))
      ->capture_default_str();
  command.add_option("--d", cusum.d, "increase of that share that is unacceptable")
      ->check(cli::Range(0.001, 0.49))
      ->capture_default_str();
  command.add_option("--limit", cusum.h, "value of S at which a learner is competent")
      ->check(cli::Range(0.01, 1000.0))
      ->capture_default_str();
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
  cli::App* list = add("list", "List all attempts, oldest first", list_results);
  add_filter(*list, *options);
  list->add_flag("--json", options->json, "print JSON");
  add("show", "Show one attempt with its report, JSON", show_result)
      ->add_option("id", options->id, "its id, as `results list` prints it")
      ->required();
  cli::App* curve =
      add("curve", "Learning curves (LC-CUSUM) with warnings of relapse", show_curves);
  add_filter(*curve, *options);
  curve->add_flag("--json", options->json, "print JSON");
  add_cusum(*curve, options->cusum);
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
  cli::App* cohort =
      add("cohort", "Write a page about a class: learners, results, learning curves, errors",
          write_cohort);
  add_filter(*cohort, *options);
  add_cusum(*cohort, options->cusum);
  cohort->add_option("--out", options->out, "the page to write, .html or .pdf");
  cohort->add_flag("--names", options->names,
                   "print the learners' names that are stored on this computer");
  cohort->add_flag("--json", options->json, "print the figures as JSON");
  cli::App* compare = add("compare", "Compare two attempts", compare_results);
  compare->add_option("a", options->id, "id of the first, as `results list` prints it")->required();
  compare->add_option("b", options->other, "id of the second")->required();
  compare->add_flag("--json", options->json, "print JSON");
  add_result_sending(*group, exit_code);
  add_result_rescore(*group, exit_code);
  add_result_standard(*group, exit_code);
}

}  // namespace osteon
