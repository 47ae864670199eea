#include "commands/scenario_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "cases/open_case.h"
#include "commands/attempt_watch.h"
#include "commands/headless.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "osteon/record/recording_note.h"
#include "osteon/surgeon/probe_surgeon.h"
#include "osteon/surgeon/scope_surgeon.h"
#include "osteon/surgeon/surgeon.h"
#include "osteon/surgeon/tour_surgeon.h"
#include "runs/tray.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The surgeon's will moves an emulated hand with a mass and a grip, which yields to the force.
class SurgeonHand : public HandInLoop {
 public:
  SurgeonHand(HandPlayer& surgeon, const HandParams& hand, double tick_s)
      : surgeon_(surgeon), hand_(hand), wanted_(surgeon.start()), tick_s_(tick_s) {
    hand_.reset(wanted_);
  }

  ToolInput move() override {
    const Pose next = surgeon_.step(tick_s_);
    hand_.step(tick_s_, wanted_, (next.p - wanted_.p) / tick_s_, force_W_);
    wanted_ = next;
    return {hand_.pose(), hand_.velocity(), hand_.angular_velocity(), 0};
  }
  void feel(const Vec3& force_W) override {
    force_W_ = force_W;
    surgeon_.feel(force_W);
  }

 private:
  HandPlayer& surgeon_;
  VirtualHand hand_;
  Pose wanted_;
  double tick_s_;
  Vec3 force_W_ = Vec3::Zero();
};

Result<fs::path> asset_folder(const char* name) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return *data / "assets" / name;
}

}  // namespace

Result<std::vector<Scenario>> shipped_scenarios() {
  const auto folder = asset_folder("scenarios");
  if (!folder) return tl::unexpected(folder.error());
  std::vector<fs::path> files;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(*folder, ec))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (ec) return fail("cannot be read (" + ec.message() + ")", folder->string());
  std::sort(files.begin(), files.end());
  std::vector<Scenario> scenarios;
  for (const fs::path& file : files) {
    auto scenario = load_scenario(file);
    if (!scenario) return tl::unexpected(scenario.error());
    scenarios.push_back(std::move(*scenario));
  }
  return scenarios;
}

Result<Scenario> open_scenario(const std::string& spec) {
  std::error_code ec;
  if (fs::is_regular_file(spec, ec)) return load_scenario(spec);
  const auto all = shipped_scenarios();
  if (!all) return tl::unexpected(all.error());
  std::string names;
  for (const Scenario& scenario : *all) {
    if (scenario.name == spec) return scenario;
    names += (names.empty() ? "" : ", ") + scenario.name;
  }
  return fail("there is no scenario '" + spec + "' and no file of that name", "scenario",
              "Use one of: " + names);
}

Result<std::optional<Standard>> shipped_standard(const std::string& scenario) {
  const auto folder = asset_folder("standards");
  if (!folder) return tl::unexpected(folder.error());
  const fs::path file = *folder / (scenario + ".toml");
  std::error_code ec;
  if (!fs::exists(file, ec)) return std::optional<Standard>{};
  auto standard = load_standard(file);
  if (!standard) return tl::unexpected(standard.error());
  return std::optional<Standard>(std::move(*standard));
}

// Side and finding of a drawn patient: a function of the seed and of nothing else.
std::string drawn_words(const Scenario& scenario, std::uint64_t seed) {
  Random random(seed * 6364136223846793005u + 1442695040888963407u);
  const double side = random.uniform(), ill = random.uniform(), which = random.uniform();
  const auto pick = [](const std::vector<std::string>& from, double share) {
    return from[std::min(from.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(from.size())))];
  };
  std::string words;
  if (!scenario.sides.empty()) words += ":" + pick(scenario.sides, side);
  if (!scenario.findings.empty() && ill < 0.5) words += ":" + pick(scenario.findings, which);
  for (const std::string& word : scenario.always) words += ":" + word;
  return words;
}

std::string case_spec_of(const Scenario& scenario, const std::string& case_spec,
                         std::optional<std::uint64_t> seed) {
  std::string spec = case_spec;
  if (spec.empty()) spec = "builtin:" + scenario.anatomy;
  // What every patient of the exercise has stands behind a seed alone.
  if (!scenario.always.empty() && !seed) seed = 0;
  if (case_spec.empty() && seed) spec += ":" + std::to_string(*seed) + drawn_words(scenario, *seed);
  if (spec.find('#') == std::string::npos && scenario.felt != "pieces") spec += "#" + scenario.felt;
  return spec;
}

namespace {

// An exercise that names portals on its way is a tour: its hands take turns.
bool is_tour(const ScenarioPlan& plan) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.rule.kind == "through") return true;
  return false;
}

std::vector<std::unique_ptr<HandPlayer>> tour_players(std::span<const PlannedHand> hands,
                                                      const ScenarioPlan& plan,
                                                      const Case& the_case, const Skill& skill) {
  std::vector<TourTool> tools;
  for (const PlannedHand& hand : hands)
    tools.push_back({hand.name, hand.optics, hand.shaft_offset_T, hand.shaft_radius_m,
                     hand.tip_radius_m, hand.portal_W.value_or(Vec3(0, 0, 0.1))});
  const auto tour =
      std::make_shared<const TourPlan>(plan_tour(plan, the_case, skill, std::move(tools)));
  const auto progress = std::make_shared<TourProgress>();
  std::vector<std::unique_ptr<HandPlayer>> players;
  for (std::size_t h = 0; h < hands.size(); ++h)
    players.push_back(std::make_unique<TourHand>(tour, progress, h, skill));
  return players;
}

// Who plays each hand: one that looks through its instrument looks for marks, or after the probe
// where the exercise has no marks; a probe with a portal works through it; any other touches.
std::vector<std::unique_ptr<HandPlayer>> players_of(std::span<const PlannedHand> hands,
                                                    const ScenarioPlan& plan, const Case& the_case,
                                                    const Skill& skill, double tip_radius_m) {
  if (is_tour(plan)) return tour_players(hands, plan, the_case, skill);
  std::vector<std::unique_ptr<HandPlayer>> players;
  const ProbeSurgeon* probe = nullptr;
  for (const PlannedHand& hand : hands) {
    const Vec3 portal_W = hand.portal_W.value_or(Vec3(0, 0, 0.1));
    if (hand.optics && probe)
      players.push_back(
          std::make_unique<FollowingScope>(*probe, plan, skill, *hand.optics, portal_W));
    else if (hand.optics)
      players.push_back(std::make_unique<ScopeSurgeon>(
          plan, the_case, skill, ScopeSurgeon::Scope{*hand.optics, portal_W, hand.shaft_radius_m}));
    else if (hand.portal_W) {
      auto made = std::make_unique<ProbeSurgeon>(plan, the_case, skill, portal_W, tip_radius_m);
      probe = made.get();
      players.push_back(std::move(made));
    } else
      players.push_back(std::make_unique<Surgeon>(plan, the_case, skill, tip_radius_m));
  }
  return players;
}

ProbePath holding(const std::string& instrument) {
  ProbePath path;
  if (instrument == kWristProbe) return path;
  path.samples.emplace_back(0.0, Pose{}, false);
  path.samples.back().instrument = instrument;
  return path;
}

// What a recording must know so that the attempt can be judged again.
Result<void> note_attempt(const ScenarioRun& run, const ScenarioOutcome& outcome) {
  if (!run.record_to) return {};
  const fs::path& file = *run.record_to;
  if (!run.scenario.source_text.empty())
    if (auto ok = write_note(file, "scenario", run.scenario.source_text); !ok) return ok;
  if (run.standard)
    if (auto ok = write_note(file, "standard", to_toml(*run.standard)); !ok) return ok;
  if (auto ok = write_note(file, "surgeon", run.skill.name); !ok) return ok;
  return write_note(file, "report", to_json(outcome.report, outcome.outcome));
}

}  // namespace

Result<ScenarioOutcome> run_scenario(const ScenarioRun& run) {
  const auto the_case = open_felt_case(run.case_spec);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto plan = plan_scenario(run.scenario, **the_case);
  if (!plan) return tl::unexpected(plan.error());
  const auto hands = plan_hands(run.scenario, **the_case);
  if (!hands) return tl::unexpected(hands.error());
  HeadlessRun headless;
  const auto players =
      players_of(*hands, *plan, **the_case, run.skill, headless.settings.probe_radius_m);
  const auto all_done = [&] {
    return std::all_of(players.begin(), players.end(), [](const auto& p) { return p->done(); });
  };
  if (all_done())
    return fail("nothing of the scenario can be reached", run.case_spec,
                "Check the case with: osteon case check");
  AttemptWatch watch(*plan, **the_case, *hands, headless.settings.haptic.tick_s);
  headless.the_case = *the_case;
  headless.case_source = run.case_spec;
  headless.settings.seed = run.skill.seed;
  headless.record_to = run.record_to;
  headless.longest_s = run.scenario.time_limit_s;
  for (std::size_t h = 0; h < hands->size(); ++h)
    headless.hands.push_back({(*hands)[h].name, holding((*hands)[h].instrument),
                              [&headless, &player = *players[h]](double tick_s) {
                                return std::make_unique<SurgeonHand>(player, headless.hand, tick_s);
                              }});
  headless.done = [&] { return watch.over() || all_done(); };
  headless.on_hands = [&](std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
    watch.add(tools, bones);
  };
  auto reports = simulate_hands(headless);
  if (!reports) return tl::unexpected(reports.error());
  auto outcome = watch.finish(run.standard ? &*run.standard : nullptr);
  if (!outcome) return tl::unexpected(outcome.error());
  ScenarioOutcome done{std::move(reports->reports.front()), std::move(*outcome), {}};
  for (const auto& player : players)
    done.unreachable.insert(done.unreachable.end(), player->unreachable().begin(),
                            player->unreachable().end());
  if (auto noted = note_attempt(run, done); !noted) return tl::unexpected(noted.error());
  return done;
}

}  // namespace osteon
