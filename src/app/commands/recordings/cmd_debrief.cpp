#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/parser.h"
#include "commands/teaching/scenario_run.h"
#include "commands/teaching/skill_trial.h"
#include "exercises/debrief.h"
#include "exercises/debrief_pictures.h"
#include "exercises/ghost/ghost_recording.h"
#include "exercises/result_files.h"
#include "loops/stop_signal.h"

namespace osteon {
namespace {

struct DebriefCommand {
  DebriefOrder order;
  std::string out, ghost = "expert";
  bool no_pictures = false;
};

// What an expert did on the same patient. Without the virtual one the pages are whole but for that;
// fails where the recording that was named cannot be shown.
Result<void> add_expert_to(Debrief& debrief, const std::string& ghost) {
  if (ghost == "off" || (ghost == "expert" && !wants_expert(debrief))) return {};
  if (!debrief.scenario)
    return fail("the recording contains no exercise", "--ghost", "Leave it out");
  const GhostWanted wanted{*debrief.scenario, debrief.case_spec, debrief.the_case->hash};
  const auto go_on = [] { return !stop_requested(); };
  if (ghost == "expert")
    std::fprintf(
        stderr, "osteon: the virtual expert performs the exercise (--ghost off leaves this out)\n");
  const auto track =
      ghost == "expert" ? ghost_of_expert(wanted, go_on) : ghost_of_recording(ghost, wanted);
  if (track)
    show_expert(*track, debrief);
  else if (ghost != "expert")
    return tl::unexpected(track.error());
  else
    std::fprintf(stderr, "osteon: no expert's paths: %s\n", track.error().message().c_str());
  return {};
}

int run_debrief(DebriefCommand command) {
  const auto recording = recording_named(command.order.recording.string());
  if (!recording) return report_error(recording.error());
  command.order.recording = *recording;
  auto debrief = make_debrief(command.order);
  if (!debrief) return report_error(debrief.error());
  if (auto added = add_expert_to(*debrief, command.ghost); !added)
    return report_error(added.error());
  std::vector<DebriefPicture> pictures;
  if (!command.no_pictures) {
    auto drawn = draw_debrief(*debrief);
    if (drawn)
      pictures = std::move(*drawn);
    else
      std::fprintf(stderr, "osteon: no pictures: %s\n", drawn.error().message().c_str());
  }
  if (auto saved = save_debrief(*debrief, command.out, pictures); !saved)
    return report_error(saved.error());
  if (debrief->outcome) std::fputs(to_text(*debrief->outcome).c_str(), stdout);
  if (!debrief->identical) std::printf("DIFFERENT from the recording when replayed\n");
  return debrief->identical ? kExitDone : kExitNo;
}

struct SkillCommand {
  std::vector<std::string> scenarios;
  int experts = 20, novices = 20;
  bool json = false;
};

nlohmann::ordered_json or_null(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json trial_json(const std::string& name, const SkillTrial& trial) {
  const SkillStudy& s = trial.study;
  return {{"scenario", name},
          {"experts", s.expert_scores.size()},
          {"novices", s.novice_scores.size()},
          {"auc", s.auc},
          {"auc_se", s.auc_se},
          {"reliability", or_null(s.reliability)},
          {"mark", or_null(s.mark)},
          {"without_mark", s.without_mark},
          {"left_out", s.left_out},
          {"experts_below_mark", s.experts_failed},
          {"novices_above_mark", s.novices_passed},
          {"experts_not_passed", trial.experts_not_passed},
          {"novices_passed", trial.novices_passed},
          {"expert_scores", s.expert_scores},
          {"novice_scores", s.novice_scores}};
}

void print_trial(const std::string& name, const SkillTrial& trial) {
  const SkillStudy& s = trial.study;
  const std::size_t all = s.expert_scores.size() + s.novice_scores.size();
  for (const std::string& metric : s.left_out)
    std::printf("%-18s without '%s': it is the same for all experts, but one at most\n",
                name.c_str(), metric.c_str());
  char reliability[16] = "none";  // of one metric there is none
  if (std::isfinite(s.reliability))
    std::snprintf(reliability, sizeof reliability, "%.2f", s.reliability);
  std::printf("%-18s AUC %.3f (SE %.3f)  reliability %s  mark ", name.c_str(), s.auc, s.auc_se,
              reliability);
  if (2 * static_cast<std::size_t>(s.without_mark) >= all) {
    std::printf(
        "none\n%-18s for %d of %zu persons the scores of the others give no mark:\n%-18s all "
        "scores of a group are the lowest possible\n",
        "", s.without_mark, all, "");
    return;
  }
  std::printf("%.1f\n", s.mark);
  std::printf(
      "%-18s judged by the score alone: %d of %zu experts fail, %d of %zu novices pass; also by "
      "stages and errors: %d and %d\n",
      "", s.experts_failed, s.expert_scores.size(), s.novices_passed, s.novice_scores.size(),
      trial.experts_not_passed, trial.novices_passed);
}

int run_skill(const SkillCommand& command) {
  std::vector<Scenario> scenarios;
  if (command.scenarios.empty()) {
    auto all = shipped_scenarios();
    if (!all) return report_error(all.error());
    scenarios = std::move(*all);
  }
  for (const std::string& name : command.scenarios) {
    auto scenario = open_scenario(name);
    if (!scenario) return report_error(scenario.error());
    scenarios.push_back(std::move(*scenario));
  }
  auto json = nlohmann::ordered_json::array();
  for (const Scenario& scenario : scenarios) {
    const auto trial = try_skill(scenario, command.experts, command.novices);
    if (!trial) return report_error(trial.error());
    json.push_back(trial_json(scenario.name, *trial));
    if (!command.json) print_trial(scenario.name, *trial);
  }
  if (command.json) std::printf("%s\n", json.dump(2).c_str());
  return kExitDone;
}

}  // namespace

void add_debrief_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<DebriefCommand>();
  DebriefOrder* const order = &options->order;
  cli::App* command = app.add_subcommand(
      "debrief",
      "Replay a recorded attempt, judge it again and write a report to print.\n"
      "Exit code: 0 written, 1 written, but the replay differs from the recording, 2 not written");
  command
      ->add_option("recording", order->recording, "recording (.osr), or the id of a stored attempt")
      ->required();
  command->add_option("--out", options->out, "PDF file to write")->required();
  command
      ->add_option("--ghost", options->ghost,
                   "whose paths to print beside the learner's: expert, the virtual expert on the "
                   "same patient; FILE.osr, a recording of it; or off")
      ->capture_default_str();
  command->add_flag("--no-pictures", options->no_pictures,
                    "leave out the pictures of paths and surfaces");
  command->add_option("--case", order->case_spec, "a case; default: the recording's own");
  command->add_option("--scenario", order->scenario,
                      "name or file; default: the one stored in the recording");
  command->add_option("--standard", order->standard,
                      "standard to judge against, TOML; default: the one that was used");
  command->callback([options, &exit_code] { exit_code = run_debrief(*options); });
}

void add_skill_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<SkillCommand>();
  cli::App* command = app.add_subcommand(
      "skill",
      "Measure how well scores separate simulated experts from simulated novices. Each attempt is "
      "judged\nby a standard that was set without it. This says nothing about people");
  command->add_option("scenario", options->scenarios, "names or files; default: all");
  command->add_option("--experts", options->experts, "number of simulated experts")
      ->check(cli::Range(3, 1000))
      ->capture_default_str();
  command->add_option("--novices", options->novices, "number of simulated novices")
      ->check(cli::Range(3, 1000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options, &exit_code] { exit_code = run_skill(*options); });
}

}  // namespace osteon
