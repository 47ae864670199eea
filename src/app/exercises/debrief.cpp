#include "exercises/debrief.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/open_case.h"
#include "exercises/attempt_watch.h"
#include "exercises/graft_order.h"
#include "exercises/guided_time.h"
#include "exercises/portal_choice.h"
#include "exercises/seat_files.h"
#include "exercises/surface_heat.h"
#include "osteon/procedure/hand_reports.h"
#include "osteon/record/recording.h"
#include "osteon/record/recording_note.h"
#include "osteon/session/session.h"
#include "runs/hands/tray.h"
#include "runs/pictures/carved_picture.h"
#include "runs/replays/recorded_case.h"
#include "runs/reports/exam_report.h"
#include "runs/reports/portal_report.h"

namespace osteon {
namespace {

constexpr double kTraceHz = 20;

Result<std::optional<Scenario>> scenario_of(const DebriefOrder& order) {
  if (!order.scenario.empty()) {
    auto scenario = open_scenario(order.scenario);
    if (!scenario) return tl::unexpected(scenario.error());
    return std::optional<Scenario>(std::move(*scenario));
  }
  const auto note = read_note(order.recording, "scenario");
  if (!note) return tl::unexpected(note.error());
  if (!*note) return std::optional<Scenario>{};
  auto scenario = parse_scenario(**note, order.recording.string() + " (its exercise)");
  if (!scenario) return tl::unexpected(scenario.error());
  return std::optional<Scenario>(std::move(*scenario));
}

Result<std::optional<Standard>> standard_for(const DebriefOrder& order, const Scenario& scenario) {
  if (!order.standard.empty()) {
    auto standard = load_standard(order.standard);
    if (!standard) return tl::unexpected(standard.error());
    return std::optional<Standard>(std::move(*standard));
  }
  const auto note = read_note(order.recording, "standard");
  if (!note) return tl::unexpected(note.error());
  if (!*note) return standard_in_use(scenario.name);
  auto standard = parse_standard(**note, order.recording.string() + " (its standard)");
  if (!standard) return tl::unexpected(standard.error());
  return std::optional<Standard>(std::move(*standard));
}

Result<std::vector<AttemptPause>> pauses_of(const std::filesystem::path& recording) {
  const auto note = read_note(recording, "pauses");
  if (!note) return tl::unexpected(note.error());
  return parse_pauses(*note ? **note : "", recording.string());
}

Result<StatedFindings> stated_in(const std::filesystem::path& recording, const Scenario& scenario) {
  const auto note = read_note(recording, "findings");
  if (!note) return tl::unexpected(note.error());
  if (!*note) return StatedFindings{};
  return parse_findings(**note, scenario.asks, recording.string() + " (what was stated)");
}

// The graft that was made before it was placed; none: one that fits.
Result<std::optional<MadeGraft>> graft_in(const std::filesystem::path& recording) {
  const auto note = read_note(recording, "graft");
  if (!note) return tl::unexpected(note.error());
  if (!*note) return std::optional<MadeGraft>{};
  const auto made = made_graft(**note, recording.string() + " (its graft)");
  if (!made) return tl::unexpected(made.error());
  return std::optional<MadeGraft>(*made);
}

// The part of the exercise that was played; none: all of it was.
Result<std::optional<AttemptPart>> part_in(const std::filesystem::path& recording) {
  const auto note = read_note(recording, "part");
  if (!note) return tl::unexpected(note.error());
  if (!*note) return std::optional<AttemptPart>{};
  auto part = parse_part(**note, recording.string());
  if (!part) return tl::unexpected(part.error());
  return std::optional<AttemptPart>(std::move(*part));
}

// Gathers one hand's values, from a tick on.
class TraceMaker {
 public:
  TraceMaker(double tick_s, std::uint64_t from_tick)
      : stride_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(1 / (kTraceHz * tick_s)))),
        from_s_(static_cast<double>(from_tick) * tick_s) {}
  void add(const ToolState& tool) {
    peak_n_ = std::max(peak_n_, is_finite(tool.force_W) ? tool.force_W.norm() : 0.0);
    if (tool.tick % stride_ != 0 || !is_finite(tool.X_WP)) return;
    trace_.time_s.push_back(tool.time_s - from_s_);
    trace_.force_n.push_back(peak_n_);
    trace_.tip_W.push_back(tool.X_WP.p);
    peak_n_ = 0;
  }
  HandTrace finish(const std::string& name, const Report& report) {
    trace_.name = name;
    for (const BoneReport& bone : report.bones)
      if (bone.touched()) trace_.touched.push_back(bone);
    std::stable_sort(trace_.touched.begin(), trace_.touched.end(),
                     [](const auto& a, const auto& b) { return a.peak_force_n > b.peak_force_n; });
    return std::move(trace_);
  }

 private:
  std::uint64_t stride_;
  double from_s_;
  double peak_n_ = 0;
  HandTrace trace_;
};

// Judges again what is repeated: hands come one after the other, the last of a tick completes it.
struct JudgedAgain {
  std::unique_ptr<ScenarioPlan> plan;
  std::vector<PlannedHand> hands;
  std::unique_ptr<AttemptWatch> watch;
  std::vector<ToolState> tools;
  std::function<void(std::span<const ToolState* const>, const ScenarioState&)> on_judged;

  Result<void> begin(const Scenario& scenario, const Case& the_case, double tick_s,
                     std::size_t recorded_hands, TunnelSources sources,
                     const std::vector<std::string>& tray) {
    auto planned = plan_scenario(scenario, the_case);
    if (!planned) return tl::unexpected(planned.error());
    auto held = plan_hands(scenario, the_case);
    if (!held) return tl::unexpected(held.error());
    if (held->size() != recorded_hands)
      return fail("the exercise is for " + std::to_string(held->size()) +
                      " hands, but the recording has " + std::to_string(recorded_hands),
                  scenario.name, "Name the exercise that was played with --scenario");
    plan = std::make_unique<ScenarioPlan>(std::move(*planned));
    hands = std::move(*held);
    watch = std::make_unique<AttemptWatch>(*plan, the_case, hands, tick_s);
    watch->watch_tunnels(std::move(sources));
    watch->watch_tray(tray);
    tools.resize(hands.size());
    return {};
  }
  void add(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
           std::span<const Event> events) {
    if (!watch || hand >= tools.size()) return;
    for (const Event& event : events) {
      if (event.kind == EventKind::kMark) watch->keep(event.subject);
      if (event.kind == EventKind::kRestored) watch->go_back(event.subject);
    }
    tools[hand] = tool;
    if (hand + 1 < tools.size()) return;
    std::vector<const ToolState*> all;
    for (const ToolState& each : tools) all.push_back(&each);
    watch->add(all, bones);
    if (on_judged) on_judged(all, watch->state());
  }
};

}  // namespace

Result<Debrief> make_debrief(const DebriefOrder& order) {
  auto recording = RecordingReader::open(order.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto spec = recorded_case_spec(order.recording, order.case_spec, recording->header());
  if (!spec) return tl::unexpected(spec.error());
  const auto the_case = open_case(*spec, {}, parts_of(recording->header()));
  if (!the_case) return tl::unexpected(the_case.error());
  const auto settings = parse_settings(recording->header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  auto scenario = scenario_of(order);
  if (!scenario) return tl::unexpected(scenario.error());
  const std::size_t hands = recording->header().hands;
  const double tick_s = settings->haptic.tick_s;
  JudgedAgain again;
  again.on_judged = order.on_judged;
  ReplayOptions how;
  if (auto ready = take_instruments(recording->header(), **the_case, how); !ready)
    return tl::unexpected(ready.error());
  CarvedPicture carved(how.carving);
  if (how.carving) how.on_cuts = [&](const CutsPatch& patch, double) { carved.take(patch); };
  const auto carved_bone = [&](std::uint32_t bone) { return carved.cut_bone(bone); };
  if (*scenario) {
    TunnelSources sources{*spec, settings->tray, carved_bone};
    const auto graft = graft_in(order.recording);
    if (!graft) return tl::unexpected(graft.error());
    if (*graft) leave_out_bench_stages(**scenario);
    leave_out_what_case_has(**scenario, *spec);
    sources.graft = *graft;
    if (auto begun =
            again.begin(**scenario, **the_case, tick_s, hands, std::move(sources), settings->tray);
        !begun)
      return tl::unexpected(begun.error());
  }
  auto pauses = pauses_of(order.recording);
  if (!pauses) return tl::unexpected(pauses.error());
  if (again.watch) again.watch->set_pauses(std::move(*pauses));
  const auto guided = read_note(order.recording, "guided");
  if (!guided) return tl::unexpected(guided.error());
  const auto guided_s = parse_guided(*guided ? **guided : "", order.recording.string());
  if (!guided_s) return tl::unexpected(guided_s.error());
  auto part = part_in(order.recording);
  if (!part) return tl::unexpected(part.error());
  if (*part && again.watch) {
    const auto stages = stages_of(**part, **scenario);
    if (!stages) return tl::unexpected(stages.error());
    again.watch->set_part(**part, *stages);
  }
  const std::uint64_t from_tick = *part ? (*part)->from_tick : 0;
  how.reported_after = from_tick;
  std::vector<TraceMaker> traces(hands, TraceMaker(tick_s, from_tick));
  DamageMaker damage(**the_case, hands);
  SurfaceHeat heat(**the_case);
  const Session* session = nullptr;
  how.at_begin = [&](const Session& begun) { session = &begun; };
  const std::uint64_t ticks = std::max<std::uint64_t>(100, recording->ticks(0));
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    std::span<const Event> events) {
    if (order.on_share && hand == 0 && tool.tick % (ticks / 100) == 0)
      order.on_share(static_cast<double>(tool.tick) / static_cast<double>(ticks));
    if (tool.tick > from_tick) {
      traces[hand].add(tool);
      damage.touch(hand, tool, bones);
    }
    heat.see(*session);
    again.add(hand, tool, bones, events);
  };
  const auto replayed = replay(*recording, *the_case, how);
  if (!replayed) return tl::unexpected(replayed.error());
  heat.finish(damage);
  Debrief debrief;
  debrief.case_name = (*the_case)->name;
  debrief.duration_s = replayed->report.duration_s;
  debrief.identical = replayed->identical;
  debrief.reports = replayed->reports;
  debrief.case_spec = *spec;
  debrief.the_case = *the_case;
  debrief.damage = damage.finish();
  debrief.guided_s = *guided_s;
  const auto surgeon = read_note(order.recording, "surgeon");
  if (surgeon && *surgeon) debrief.surgeon = **surgeon;
  for (std::size_t h = 0; h < hands; ++h)
    debrief.hands.push_back(traces[h].finish(settings->hands[h].name, replayed->reports[h]));
  if (!*scenario) return debrief;
  const auto standard = standard_for(order, **scenario);
  if (!standard) return tl::unexpected(standard.error());
  const auto stated = stated_in(order.recording, **scenario);
  if (!stated) return tl::unexpected(stated.error());
  auto outcome = again.watch->finish(*standard ? &**standard : nullptr, *stated);
  if (!outcome) return tl::unexpected(outcome.error());
  debrief.outcome = std::move(*outcome);
  if (*standard && !*part) debrief.pass_score = (*standard)->pass_score;
  if (debrief.guided_s > 0) debrief.outcome->metrics["guided_s"] = debrief.guided_s;
  if (const TunnelWatch* tunnels = again.watch->tunnels()) {
    debrief.acl = tunnels->report();
    if (tunnels->problem()) debrief.not_measured = tunnels->problem()->message();
  }
  const GraftWatch& graft = again.watch->graft();
  if (graft.plan()) debrief.graft = GraftReport{*graft.plan(), graft.state()};
  const PlacingWatch& placing = again.watch->placing();
  if (const auto plan = placing.plan())
    debrief.placing = PlacingReport{*plan, placing.state(), placing.bent()};
  debrief.exam = again.watch->exam();
  debrief.made_portals = again.watch->made_portals();
  debrief.part = std::move(*part);
  debrief.scenario = std::move(**scenario);
  return debrief;
}

void show_expert(const GhostTrack& track, Debrief& debrief) {
  constexpr auto kStride = static_cast<std::size_t>(kGhostHz / kTraceHz + 0.5);
  debrief.expert.clear();
  for (const auto& hand : track.hands) {
    auto& way = debrief.expert.emplace_back();
    for (std::size_t i = 0; i < hand.size(); i += kStride)
      if (is_finite(hand[i].X_WT)) way.push_back(hand[i].X_WT.p);
  }
}

bool wants_expert(const Debrief& debrief) {
  return debrief.scenario && debrief.scenario->ghost && debrief.surgeon != "expert";
}

std::string report_of(const Debrief& debrief) {
  std::vector<std::string> names;
  for (const HandTrace& hand : debrief.hands) names.push_back(hand.name);
  const std::string text = with_tunnels(to_json(debrief.reports, names, *debrief.outcome),
                                        debrief.acl, debrief.not_measured);
  if (!debrief.acl && !debrief.graft && !debrief.placing && debrief.made_portals.empty() &&
      !debrief.part)
    return text;
  auto json = nlohmann::ordered_json::parse(text);
  if (debrief.part) json["part"] = {{"from", debrief.part->from}, {"to", debrief.part->to}};
  // In the report of a whole reconstruction `acl.graft` is what holds it.
  if (debrief.graft) json["acl"][debrief.acl ? "made" : "graft"] = to_json(*debrief.graft);
  if (debrief.the_case)
    add_portals(debrief.made_portals, *debrief.the_case, debrief.case_spec, json);
  if (debrief.placing) json["acl"]["placing"] = to_json(*debrief.placing);
  if (debrief.exam) json["acl"]["examined"] = to_json(*debrief.exam);
  return json.dump(2) + "\n";
}

}  // namespace osteon
