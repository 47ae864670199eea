#include "commands/teaching/scenario_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cases/open_case.h"
#include "commands/support/headless.h"
#include "commands/teaching/played_hand.h"
#include "commands/teaching/reconstruction_plan.h"
#include "exercises/attempt_watch.h"
#include "exercises/debrief.h"
#include "exercises/exam_order.h"
#include "exercises/graft_order.h"
#include "exercises/skin_order.h"
#include "osteon/base/clock.h"
#include "osteon/carve/removed.h"
#include "osteon/procedure/hand_reports.h"
#include "osteon/record/recording_note.h"
#include "osteon/scene/tool_set.h"
#include "osteon/surgeon/acl_surgeon.h"
#include "osteon/surgeon/graft_surgeon.h"
#include "osteon/surgeon/parts_hand.h"
#include "osteon/surgeon/placing_surgeon.h"
#include "osteon/surgeon/probe_surgeon.h"
#include "osteon/surgeon/puncture_surgeon.h"
#include "osteon/surgeon/scope_surgeon.h"
#include "osteon/surgeon/surgeon.h"
#include "osteon/surgeon/tour_surgeon.h"
#include "osteon/surgeon/way_surgeon.h"
#include "runs/hands/tray.h"
#include "runs/reports/exam_report.h"
#include "runs/reports/portal_report.h"

namespace osteon {
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
  const HandPlayer* probe = nullptr;
  for (const PlannedHand& hand : hands) {
    const Vec3 portal_W = hand.portal_W.value_or(Vec3(0, 0, 0.1));
    if (hand.optics && probe)
      players.push_back(
          std::make_unique<FollowingScope>(*probe, plan, skill, *hand.optics, portal_W));
    else if (hand.optics)
      players.push_back(std::make_unique<ScopeSurgeon>(
          plan, the_case, skill, ScopeSurgeon::Scope{*hand.optics, portal_W, hand.shaft_radius_m}));
    else if (auto way = plan_way(plan, the_case, skill, {portal_W, hand.tip_radius_m});
             hand.portal_W && !way.empty()) {
      auto made = std::make_unique<WaySurgeon>(std::move(way), skill, portal_W);
      probe = made.get();
      players.push_back(std::move(made));
    } else if (hand.portal_W) {
      auto made = std::make_unique<ProbeSurgeon>(plan, the_case, skill, portal_W, tip_radius_m);
      probe = made.get();
      players.push_back(std::move(made));
    } else
      players.push_back(std::make_unique<Surgeon>(plan, the_case, skill, tip_radius_m));
  }
  return players;
}

}  // namespace

std::string to_json(const ScenarioOutcome& done) {
  const std::string text =
      with_tunnels(to_json(done.reports, done.hands, done.outcome), done.acl, done.not_measured);
  if (!done.acl && !done.graft && !done.placing && done.made_portals.empty() && !done.part)
    return text;
  auto json = nlohmann::ordered_json::parse(text);
  if (done.part) json["part"] = {{"from", done.part->from}, {"to", done.part->to}};
  if (done.graft) json["acl"][done.acl ? "made" : "graft"] = to_json(*done.graft);
  if (done.placing) json["acl"]["placing"] = to_json(*done.placing);
  if (done.exam) json["acl"]["examined"] = to_json(*done.exam);
  add_portals(done.made_portals, *done.the_case, done.case_spec, json);
  return json.dump(2) + "\n";
}

namespace {

// One hand makes a graft.
Result<void> plan_bench_work(const ScenarioRun& run, const Case& the_case,
                             std::span<const PlannedHand> hands, HeadlessRun& headless) {
  if (hands.size() != 1)
    return fail("making a graft needs one hand, not " + std::to_string(hands.size()),
                run.scenario.where);
  auto way = plan_graft(the_case, run.skill);
  if (!way) return tl::unexpected(way.error());
  headless.hands.push_back({hands[0].name, std::move(*way)});
  return {};
}

// One hand places a graft; any other that has a portal looks on.
Result<void> plan_placing_work(const ScenarioRun& run, const Case& the_case,
                               std::span<const PlannedHand> hands, HeadlessRun& headless) {
  for (const PlannedHand& hand : hands) {
    auto way = hand.portal_W ? plan_placing_scope(the_case, *hand.portal_W, hand.instrument)
                             : plan_graft_placing(the_case, run.skill);
    if (!way) return tl::unexpected(way.error());
    headless.hands.push_back({hand.name, std::move(*way)});
  }
  return {};
}

bool asks_for_portals(const ScenarioPlan& plan) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.rule.kind == "portal_made") return true;
  return false;
}

// One hand makes the portals, the one with the scope looks on.
Result<void> plan_puncture_work(const ScenarioRun& run, const Case& the_case,
                                std::span<const PlannedHand> hands, HeadlessRun& headless) {
  const auto scope = std::find_if(hands.begin(), hands.end(),
                                  [](const PlannedHand& hand) { return hand.optics.has_value(); });
  if (hands.size() != 2 || scope == hands.end())
    return fail("portals are made by two hands, one of them with a scope", run.scenario.where);
  auto ways = plan_puncture(the_case, scope->instrument, *scope->optics, run.skill);
  if (!ways) return tl::unexpected(ways.error());
  for (const PlannedHand& hand : hands)
    headless.hands.push_back({hand.name, std::move(hand.optics ? ways->scope : ways->worker)});
  return {};
}

// None: all of it.
std::optional<AttemptPart> part_of_run(const ScenarioRun& run) {
  const auto& stages = run.scenario.stages;
  if (run.to_stage.empty() || stages.empty()) return std::nullopt;
  return AttemptPart{stages.front().name, run.to_stage, 0};
}

// What goes with the recording beside the hands.
Result<void> note_beside(const ScenarioRun& run, const std::filesystem::path& recording,
                         const StatedFindings& stated) {
  if (const auto part = part_of_run(run))
    if (auto noted = write_note(recording, "part", to_text(*part)); !noted) return noted;
  if (!run.scenario.asks.empty())
    if (auto noted = write_note(recording, "findings", to_json(stated)); !noted) return noted;
  if (run.graft_json.empty()) return {};
  return write_note(recording, "graft", run.graft_json);
}

// A file that is not kept: the verdict of a live run is made from its recording alone.
class PassingFile {
 public:
  explicit PassingFile(bool wanted) {
    if (!wanted) return;
    file_ = std::filesystem::temp_directory_path() /
            ("osteon-live-" + std::to_string(steady_now_ns()) + ".osr");
  }
  ~PassingFile() {
    std::error_code gone;
    if (!file_.empty()) std::filesystem::remove(file_, gone);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path file_;
};

// Judges what was recorded, as the window does: what the loops told meanwhile may have gaps.
Result<ScenarioOutcome> play_and_judge(const ScenarioRun& run, HeadlessRun headless,
                                       const StatedFindings& stated,
                                       std::vector<std::string> unreachable) {
  const PassingFile passing(!headless.record_to);
  if (!headless.record_to) headless.record_to = passing.path();
  const std::filesystem::path& file = *headless.record_to;
  auto played = play_live(headless, std::move(*run.live), run.step_devices);
  if (!played) return tl::unexpected(played.error());
  if (auto noted = note_beside(run, file, stated); !noted) return tl::unexpected(noted.error());
  if (auto noted = note_attempt(file, run.scenario, run.standard, run.skill.name, ""); !noted)
    return tl::unexpected(noted.error());
  auto judged = make_debrief({file, run.case_spec, "", ""});
  if (!judged) return tl::unexpected(judged.error());
  ScenarioOutcome done;
  done.reports = std::move(judged->reports);
  for (const LivePlayed::Hand& hand : played->hands) done.hands.push_back(hand.name);
  if (judged->outcome) done.outcome = std::move(*judged->outcome);
  done.unreachable = std::move(unreachable);
  done.acl = std::move(judged->acl);
  done.not_measured = std::move(judged->not_measured);
  done.graft = std::move(judged->graft);
  done.placing = std::move(judged->placing);
  done.exam = std::move(judged->exam);
  done.made_portals = std::move(judged->made_portals);
  done.the_case = judged->the_case;
  done.case_spec = run.case_spec;
  done.part = part_of_run(run);
  done.identical = judged->identical;
  done.live = std::move(*played);
  if (auto noted = note_attempt(file, run.scenario, run.standard, run.skill.name, to_json(done));
      !noted)
    return tl::unexpected(noted.error());
  return done;
}

}  // namespace

Result<ScenarioOutcome> run_scenario(const ScenarioRun& run) {
  const auto part = part_of_run(run);
  const auto stages = part ? stages_of(*part, run.scenario) : Result<PartStages>(PartStages{});
  if (!stages) return tl::unexpected(stages.error());
  const auto the_case =
      open_case(run.case_spec, {}, run.scenario.soft.empty() ? CaseParts::kFelt : CaseParts::kAll);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto plan = plan_scenario(run.scenario, **the_case);
  if (!plan) return tl::unexpected(plan.error());
  const auto hands = plan_hands(run.scenario, **the_case);
  if (!hands) return tl::unexpected(hands.error());
  HeadlessRun headless;
  const bool ligament = asks_about_tunnels(*plan);
  std::vector<std::unique_ptr<HandPlayer>> players;
  const bool bench = !ligament && find_graft_bench(**the_case).has_value();
  const bool placing = !ligament && asks_for_graft(*plan);
  const bool puncture = !ligament && asks_for_portals(*plan);
  const bool by_path = ligament || bench || placing || puncture;
  if (!by_path)
    players = players_of(*hands, *plan, **the_case, run.skill, headless.settings.probe_radius_m);
  const auto all_done = [&] {
    return std::all_of(players.begin(), players.end(), [](const auto& p) { return p->done(); });
  };
  if (!by_path && all_done())
    return fail("no target of the scenario can be reached", run.case_spec,
                "Check the case with: osteon case check");
  AttemptWatch watch(*plan, **the_case, *hands, headless.settings.haptic.tick_s);
  if (part) watch.set_part(*part, *stages);
  headless.ends_when_over = part.has_value();
  headless.the_case = *the_case;
  headless.case_source = run.case_spec;
  headless.settings.seed = run.skill.seed;
  headless.settings.soft = run.scenario.soft;
  headless.settings.carve = carve_settings(run.scenario);
  headless.record_to = run.record_to;
  headless.longest_s = run.scenario.time_limit_s;
  std::vector<std::string> unreachable;
  const bool in_background = run.live && !run.step_devices;
  RunSight sight{[] { return nullptr; }, {}};
  if (ligament) {
    LaterWork work;
    work.bones = [&sight] { return sight.bones(); };
    work.room = [&watch] {
      return watch.tunnels() ? watch.tunnels()->room() : std::optional<GraftRoom>();
    };
    auto planned =
        plan_reconstruction(run, *plan, **the_case, *hands, std::move(work), headless, players);
    if (!planned) return tl::unexpected(planned.error());
    unreachable = std::move(*planned);
  }
  if (bench)
    if (auto ok = plan_bench_work(run, **the_case, *hands, headless); !ok)
      return tl::unexpected(ok.error());
  if (placing)
    if (auto ok = plan_placing_work(run, **the_case, *hands, headless); !ok)
      return tl::unexpected(ok.error());
  if (puncture)
    if (auto ok = plan_puncture_work(run, **the_case, *hands, headless); !ok)
      return tl::unexpected(ok.error());
  for (std::size_t h = 0; !ligament && h < players.size(); ++h)
    headless.hands.push_back(played_by(*players[h], (*hands)[h], headless.hand));
  headless.on_begin = [&](RunSight begun) { sight = std::move(begun); };
  TunnelSources sources{run.case_spec, tray_of_hands(headless.hands),
                        [&](std::uint32_t bone) { return sight.carved(bone); }, in_background};
  if (!run.graft_json.empty()) {
    const auto graft = made_graft(run.graft_json, "--graft");
    if (!graft) return tl::unexpected(graft.error());
    sources.graft = *graft;
  }
  watch.watch_tunnels(std::move(sources));
  watch.watch_tray(tray_of_hands(headless.hands));
  GraftOrder order;
  std::optional<ExamOrder> exam;
  if (watch.tunnels() && asks_for_exam(*plan))
    exam.emplace(**the_case, watch.tunnels()->whole_spec(), in_background);
  SkinOrder skin;
  if (watch.tunnels() && (asks_for_graft(*plan) || exam))
    headless.beside = [&]() -> std::optional<Command> {
      skin.see(*plan, watch.state(), sight.bones()->epoch);
      if (const auto said = skin.take()) return said;
      if (asks_for_graft(*plan)) order.see(watch.tunnels()->placing(), *sight.bones());
      if (const auto said = order.take()) return said;
      if (!exam) return std::nullopt;
      exam->see(watch.tunnels()->fixed(), *sight.bones());
      return exam->take();
    };
  headless.done = [&] { return watch.over() || all_done(); };
  headless.over = [&] { return watch.over(); };
  std::optional<GhostTrackMaker> way;
  if (run.keeps_way) way.emplace(headless.settings.haptic.tick_s);
  headless.on_hands = [&](std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
    watch.add(tools, bones);
    if (way) way->add(tools, watch.state());
  };
  const StatedFindings stated =
      run.stated ? *run.stated : stated_by(run.skill, run.scenario, **the_case);
  if (run.live) return play_and_judge(run, std::move(headless), stated, std::move(unreachable));
  auto reports = simulate_hands(headless);
  if (!reports) return tl::unexpected(reports.error());
  auto outcome = watch.finish(run.standard ? &*run.standard : nullptr, stated);
  if (!outcome) return tl::unexpected(outcome.error());
  ScenarioOutcome done{std::move(reports->reports),
                       std::move(reports->names),
                       std::move(*outcome),
                       std::move(unreachable),
                       {},
                       {}};
  if (watch.graft().plan()) done.graft = GraftReport{*watch.graft().plan(), watch.graft().state()};
  if (watch.placing().plan())
    done.placing =
        PlacingReport{*watch.placing().plan(), watch.placing().state(), watch.placing().bent()};
  done.exam = watch.exam();
  done.made_portals = watch.made_portals();
  done.the_case = *the_case;
  done.case_spec = run.case_spec;
  done.part = part;
  if (way) done.way = way->finish(tray_of_hands(headless.hands));
  if (watch.tunnels()) done.acl = watch.tunnels()->report();
  if (watch.tunnels() && watch.tunnels()->problem())
    done.not_measured = watch.tunnels()->problem()->message();
  if (exam && exam->problem() && done.not_measured.empty())
    done.not_measured = exam->problem()->message();
  for (const auto& player : players)
    done.unreachable.insert(done.unreachable.end(), player->unreachable().begin(),
                            player->unreachable().end());
  if (run.record_to)
    if (auto noted = note_beside(run, *run.record_to, stated); !noted)
      return tl::unexpected(noted.error());
  if (run.record_to)
    if (auto noted =
            note_attempt(*run.record_to, run.scenario, run.standard, run.skill.name, to_json(done));
        !noted)
      return tl::unexpected(noted.error());
  return done;
}

}  // namespace osteon
