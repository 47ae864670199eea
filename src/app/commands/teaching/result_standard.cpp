#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/support/cli_support.h"
#include "commands/teaching/result_sending.h"
#include "exercises/result_files.h"
#include "exercises/seat_files.h"
#include "osteon/base/file.h"
#include "osteon/procedure/group_standard.h"
#include "osteon/results/group_runs.h"
#include "osteon/results/names.h"
#include "osteon/results/standard_page.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

struct StandardCommand {
  std::string exercise, out, page, source;
  std::vector<std::string> experts, novices;
  bool use = false, json = false, names = false;
};

struct BothGroups {
  GroupRuns experts, novices;
};

// "a,b" and "a b" alike.
std::vector<std::string> split_ids(const std::vector<std::string>& words) {
  std::vector<std::string> ids;
  for (const std::string& word : words)
    for (std::size_t at = 0; at <= word.size();) {
      const std::size_t end = std::min(word.find(',', at), word.size());
      if (end > at) ids.push_back(word.substr(at, end - at));
      at = end + 1;
    }
  return ids;
}

// Experts know the program by their last attempt; novices are new to it at their first.
Result<BothGroups> groups_of(const StandardCommand& command, const Scenario& scenario) {
  const auto store = open_results();
  if (!store) return tl::unexpected(store.error());
  const auto rows = store->list({"", scenario.name});
  if (!rows) return tl::unexpected(rows.error());
  const auto able = split_ids(command.experts), fresh = split_ids(command.novices);
  for (const std::string& id : able)
    if (std::find(fresh.begin(), fresh.end(), id) != fresh.end())
      return fail("'" + id + "' is in both groups", "--novices", "Name each learner once");
  return BothGroups{
      runs_of_group(*rows, scenario.name, scenario.version, able, CountedAttempt::kLast),
      runs_of_group(*rows, scenario.name, scenario.version, fresh, CountedAttempt::kFirst)};
}

Result<Standard> draft_of(const StandardCommand& command, const Scenario& scenario,
                          const BothGroups& groups) {
  const auto now = standard_in_use(scenario.name);
  if (!now) return tl::unexpected(now.error());
  Standard draft;
  draft.scenario = scenario.name;
  draft.version = *now ? (*now)->version + 1 : 1;
  draft.source = !command.source.empty()
                     ? command.source
                     : "contrasting groups of " + std::to_string(groups.experts.metrics.size()) +
                           " experts and " + std::to_string(groups.novices.metrics.size()) +
                           " novices, exercise version " + std::to_string(scenario.version);
  for (const ScenarioMetric& m : scenario.metrics)
    draft.metrics.push_back({m.name, 0, 1, m.weight, m.lower_is_better});
  return draft;
}

// The folder may not be there yet.
Result<void> keep_own(const Standard& standard) {
  const fs::path file = own_standard_file(standard.scenario);
  std::error_code ec;
  fs::create_directories(file.parent_path(), ec);
  if (ec) return fail("cannot be made (" + ec.message() + ")", file.parent_path().string());
  return write_file_atomic(file, to_toml(standard));
}

nlohmann::ordered_json set_json(const GroupStandard& set, const BothGroups& groups) {
  const auto finite = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  auto metrics = nlohmann::ordered_json::array();
  for (const StandardMetric& m : set.standard.metrics)
    metrics.push_back({{"name", m.name}, {"mean", m.mean}, {"sd", m.sd}});
  auto without = groups.experts.without;
  without.insert(without.end(), groups.novices.without.begin(), groups.novices.without.end());
  return {{"scenario", set.standard.scenario},
          {"version", set.standard.version},
          {"pass_score", set.standard.pass_score},
          {"reliability", finite(set.study.reliability)},
          {"score_sd", set.standard.score_sd},
          {"auc", set.study.auc},
          {"auc_se", set.study.auc_se},
          {"experts", groups.experts.learners},
          {"novices", groups.novices.learners},
          {"expert_scores", set.study.expert_scores},
          {"novice_scores", set.study.novice_scores},
          {"experts_below_mark", set.study.experts_failed},
          {"novices_above_mark", set.study.novices_passed},
          {"left_out", set.study.left_out},
          {"without_attempt", without},
          {"metrics", metrics}};
}

void print_group(const char* title, const std::vector<std::string>& learners,
                 const std::vector<double>& scores, const std::vector<bool>& passed,
                 std::size_t first) {
  for (std::size_t i = 0; i < learners.size(); ++i)
    std::printf("%-7s %-16s %6.1f  %s\n", title, learners[i].c_str(), scores[i],
                passed[first + i] ? "passes" : "does not pass");
}

void print_set(const GroupStandard& set, const BothGroups& groups) {
  const SkillStudy& study = set.study;
  print_group("expert", groups.experts.learners, study.expert_scores, study.passed, 0);
  print_group("novice", groups.novices.learners, study.novice_scores, study.passed,
              study.expert_scores.size());
  for (const std::string& metric : study.left_out)
    std::printf("left out: %s, the same for all experts, but one at most\n", metric.c_str());
  std::printf("AUC %.3f (SE %.3f), ", study.auc, study.auc_se);
  if (std::isfinite(study.reliability))
    std::printf("reliability %.2f\n", study.reliability);
  else
    std::printf("no reliability: one metric is left\n");
  std::printf(
      "%s, version %d: %.1f to pass. Each judged without them, %d of %zu experts do not pass and "
      "%d of %zu novices pass\n",
      set.standard.scenario.c_str(), set.standard.version, set.standard.pass_score,
      study.experts_failed, study.expert_scores.size(), study.novices_passed,
      study.novice_scores.size());
}

Result<void> save_set(const StandardCommand& command, const GroupStandard& set,
                      const BothGroups& groups) {
  if (!command.out.empty())
    if (auto ok = write_file_atomic(command.out, to_toml(set.standard)); !ok) return ok;
  if (!command.page.empty()) {
    const auto names = command.names ? load_names(names_file()) : LearnerNames();
    if (!names) return tl::unexpected(names.error());
    const std::string html = to_html(set, groups.experts.learners, groups.novices.learners, *names);
    if (auto ok = write_file_atomic(command.page, html); !ok) return ok;
  }
  return command.use ? keep_own(set.standard) : Result<void>{};
}

void say_where(const StandardCommand& command) {
  if (!command.out.empty()) std::printf("written to %s\n", command.out.c_str());
  if (!command.page.empty()) std::printf("page written to %s\n", command.page.c_str());
  if (command.use)
    std::printf("attempts on this seat are judged by it from now on: %s\n",
                own_standard_file(command.exercise).string().c_str());
  if (command.out.empty() && !command.use)
    std::printf("nothing is set yet: --use sets it on this seat, --out FILE writes it\n");
}

int set_by_groups(StandardCommand command) {
  const auto scenario = open_scenario(command.exercise);
  if (!scenario) return report_error(scenario.error());
  command.exercise = scenario->name;
  const auto groups = groups_of(command, *scenario);
  if (!groups) return report_error(groups.error());
  for (const GroupRuns* group : {&groups->experts, &groups->novices})
    for (const std::string& who : group->without)
      std::fprintf(stderr, "not counted: %s\n", who.c_str());
  auto draft = draft_of(command, *scenario, *groups);
  if (!draft) return report_error(draft.error());
  const auto set =
      standard_of_groups(std::move(*draft), groups->experts.metrics, groups->novices.metrics);
  if (!set) return report_error(set.error());
  if (auto saved = save_set(command, *set, *groups); !saved) return report_error(saved.error());
  if (command.json) {
    std::printf("%s\n", set_json(*set, *groups).dump(2).c_str());
    return kExitDone;
  }
  print_set(*set, *groups);
  say_where(command);
  return kExitDone;
}

}  // namespace

void add_result_standard(cli::App& results, int& exit_code) {
  auto options = std::make_shared<StandardCommand>();
  cli::App* command = results.add_subcommand(
      "standard",
      "Set the standard of an exercise by contrasting groups: the experts' last attempts give the "
      "norms,\nthe mark lies where their scores and the novices' first ones part. Attempts broken "
      "off or with\na led hand do not count. Exit code: 0 set or printed, 2 the groups set no "
      "mark");
  command->add_option("exercise", options->exercise, "its name")->required();
  command->add_option("--experts", options->experts, "ids of learners who are experts")->required();
  command->add_option("--novices", options->novices, "ids of learners who are novices")->required();
  command->add_option("--out", options->out, "write the standard, TOML");
  command->add_flag("--use", options->use, "judge attempts on this seat by it from now on");
  command->add_option("--page", options->page, "write a page about it, HTML");
  command->add_flag("--names", options->names, "print the learners' names on the page");
  command->add_option("--source", options->source, "what the standard says of its origin");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options, &exit_code] { exit_code = set_by_groups(*options); });
}

}  // namespace osteon
