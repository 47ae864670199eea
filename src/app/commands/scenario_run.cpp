#include "commands/scenario_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "cases/open_case.h"
#include "commands/headless.h"
#include "osteon/base/file.h"
#include "osteon/surgeon/surgeon.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The surgeon's will moves an emulated hand with a mass and a grip, which yields to the force.
class SurgeonHand : public HandInLoop {
 public:
  SurgeonHand(Surgeon& surgeon, const HandParams& hand, double tick_s)
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
  Surgeon& surgeon_;
  VirtualHand hand_;
  Pose wanted_;
  double tick_s_;
  Vec3 force_W_ = Vec3::Zero();
};

// Judges tick by tick.
class AttemptWatch {
 public:
  AttemptWatch(const ScenarioPlan& plan, std::size_t bones, double tick_s)
      : plan_(plan),
        tick_s_(tick_s),
        events_(bones, event_limits(plan.scenario), 0, tick_s),
        meter_(tick_s),
        state_(begin_scenario(plan)) {}

  void add(const ToolState& tool) {
    now_s_ = static_cast<double>(tool.tick) * tick_s_;
    fresh_.clear();
    events_.add(tool, fresh_);
    judge_fresh();
    meter_.add(tool);
  }
  bool over() const { return state_.over; }
  Result<Outcome> finish(const Case& the_case, const Standard* standard) {
    fresh_.clear();
    events_.finish(fresh_);
    judge_fresh();
    finish_scenario(plan_, now_s_, state_);
    auto metrics = meter_.finish();
    if (!metrics) return tl::unexpected(metrics.error());
    return outcome_of(plan_, the_case, state_, std::move(*metrics), standard);
  }

 private:
  void judge_fresh() {
    for (const Event& event : fresh_) judge(plan_, event, tick_s_, state_);
  }

  const ScenarioPlan& plan_;
  double tick_s_;
  ToolEvents events_;
  AttemptMeter meter_;
  ScenarioState state_;
  std::vector<Event> fresh_;
  double now_s_ = 0;
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

std::string case_spec_of(const Scenario& scenario, const std::string& case_spec,
                         std::optional<std::uint64_t> seed) {
  std::string spec = case_spec;
  if (spec.empty()) spec = "builtin:" + scenario.anatomy;
  if (case_spec.empty() && seed) spec += ":" + std::to_string(*seed);
  if (spec.find('#') == std::string::npos && scenario.felt != "pieces") spec += "#" + scenario.felt;
  return spec;
}

Result<ScenarioOutcome> run_scenario(const ScenarioRun& run) {
  const auto the_case = open_felt_case(run.case_spec);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto plan = plan_scenario(run.scenario, **the_case);
  if (!plan) return tl::unexpected(plan.error());
  HeadlessRun headless;
  Surgeon surgeon(*plan, **the_case, run.skill, headless.settings.probe_radius_m);
  if (surgeon.done())
    return fail("no bone of the scenario can be reached in a straight line", run.case_spec,
                "Check the case with: osteon case check");
  AttemptWatch watch(*plan, (*the_case)->bones.size(), headless.settings.haptic.tick_s);
  headless.the_case = *the_case;
  headless.case_source = run.case_spec;
  headless.settings.seed = run.skill.seed;
  headless.record_to = run.record_to;
  headless.longest_s = run.scenario.time_limit_s;
  headless.user = [&](double tick_s) {
    return std::make_unique<SurgeonHand>(surgeon, headless.hand, tick_s);
  };
  headless.done = [&] { return watch.over() || surgeon.done(); };
  headless.on_tick = [&](const ToolState& tool, const BoneSnapshot&) { watch.add(tool); };
  auto report = simulate(headless);
  if (!report) return tl::unexpected(report.error());
  auto outcome = watch.finish(**the_case, run.standard ? &*run.standard : nullptr);
  if (!outcome) return tl::unexpected(outcome.error());
  return ScenarioOutcome{std::move(*report), std::move(*outcome), surgeon.unreachable()};
}

}  // namespace osteon
