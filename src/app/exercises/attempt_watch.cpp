#include "exercises/attempt_watch.h"

#include <algorithm>
#include <numbers>

#include "exercises/exam_order.h"
#include "osteon/procedure/tip_watch.h"
#include "osteon/scene/needle.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/tool_set.h"
#include "osteon/session/session.h"
#include "runs/hands/shaft_place.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

std::vector<std::uint32_t> marks_of(const ScenarioPlan& plan) {
  std::vector<std::uint32_t> marks;
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.about == SubjectKind::kLandmark && goal.heeds == EventKind::kNone &&
          goal.rule.kind != "through")
        marks.insert(marks.end(), goal.bones.begin(), goal.bones.end());
  for (const PlannedRule& error : plan.errors)
    if (error.rule.kind == "located_unseen")
      marks.insert(marks.end(), error.bones.begin(), error.bones.end());
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  return marks;
}

// The parts of bones that a goal asks to remove.
std::vector<CutPart> cut_parts_of(const ScenarioPlan& plan, const Case& the_case) {
  std::vector<CutPart> parts;
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.heeds == kCutSeen)
        parts.push_back({the_case.find(goal.rule.subjects.front()).index, goal.places_W,
                         goal.rule.numbers.at("within_mm") / 1000});
  return parts;
}

bool asks_for_tip(const ScenarioPlan& plan) {
  const auto of_tip = [](const PlannedRule& rule) { return rule.heeds == kTipAt; };
  return std::any_of(plan.errors.begin(), plan.errors.end(), of_tip) ||
         std::any_of(plan.goals.begin(), plan.goals.end(), [&](const auto& goals) {
           return std::any_of(goals.begin(), goals.end(), of_tip);
         });
}

// Of each instrument of a tray how wide a hole it drills; 0: none.
std::vector<double> drilled_widths(std::span<const std::string> tray) {
  std::vector<double> widths_m(tray.size(), 0.0);
  const auto instruments = load_instruments();
  for (std::size_t i = 0; instruments && i < tray.size(); ++i) {
    const auto named = parse_tool_name(tray[i]);
    const Instrument* found = named ? find_instrument(*instruments, named->name) : nullptr;
    if (!found || !found->removal || found->removal->way != RemovalWay::kDrill) continue;
    const auto size = named->size_mm ? find_size(*found, *named->size_mm)
                                     : std::optional<std::size_t>(found->usual_size);
    if (size) widths_m[i] = found->sizes_m[*size];
  }
  return widths_m;
}

// Which of a tray clear soft tissue.
std::vector<char> clearing_tools(std::span<const std::string> tray) {
  std::vector<char> clears(tray.size(), 0);
  const auto instruments = load_instruments();
  for (std::size_t i = 0; instruments && i < tray.size(); ++i) {
    const auto named = parse_tool_name(tray[i]);
    const Instrument* found = named ? find_instrument(*instruments, named->name) : nullptr;
    clears[i] = found && found->clears ? 1 : 0;
  }
  return clears;
}

Result<PlannedHand> plan_hand(const ScenarioHand& hand, const Case& the_case,
                              std::span<const Instrument> instruments, const std::string& where) {
  PlannedHand planned;
  planned.name = hand.name;
  planned.instrument = hand.instrument;
  planned.also = hand.also;
  const auto named = parse_tool_name(hand.instrument);
  if (!named) return tl::unexpected(named.error());
  const Instrument* instrument =
      hand.instrument == kWristProbe ? nullptr : find_instrument(instruments, named->name);
  if (!instrument && hand.instrument != kWristProbe)
    return fail("there is no instrument '" + hand.instrument + "'",
                where + ":" + std::to_string(hand.line), "See: osteon instruments");
  if (instrument && instrument->optics)
    planned.optics = ScopeOptics{instrument->optics->angle_deg * std::numbers::pi / 180,
                                 instrument->optics->field_deg * std::numbers::pi / 360};
  if (instrument) {
    const Tool tool = make_tool(*instrument, instrument->usual_size);
    planned.shaft_radius_m = 0.5 * instrument->sizes_m[instrument->usual_size];
    planned.tip_radius_m = tool.tip_radius_m;
    planned.removes = instrument->removal.has_value();
    planned.shaft_offset_T = shaft_beside_tip(tool);
    planned.pin = named->name == kGuidePin;
  }
  for (const std::string& name : hand.also) {
    const auto other = parse_tool_name(name);
    const Instrument* found = other ? find_instrument(instruments, other->name) : nullptr;
    if (!found || (other->size_mm && !find_size(*found, *other->size_mm)))
      return fail("there is no instrument '" + name + "', or none of that size",
                  where + ":" + std::to_string(hand.line), "See: osteon instruments");
  }
  if (hand.portal.empty()) return planned;
  const auto portal = find_landmark(the_case, hand.portal);
  if (!portal)
    return fail("the case '" + the_case.name + "' has no portal '" + hand.portal + "'",
                where + ":" + std::to_string(hand.line));
  planned.portal_W = the_case.landmarks[*portal].p_W;
  return planned;
}

// By ToolState::portal.
std::vector<Portal> portals_of_attempt(const Scenario& scenario, const Case& the_case) {
  SessionSettings settings;
  settings.soft = scenario.soft;
  auto portals = open_portals(the_case, settings);
  return portals ? std::move(*portals) : find_portals(the_case);
}

}  // namespace

Result<std::vector<PlannedHand>> plan_hands(const Scenario& scenario, const Case& the_case) {
  std::vector<PlannedHand> hands;
  if (scenario.hands.empty()) {
    PlannedHand probe;
    probe.instrument = kWristProbe;
    return std::vector<PlannedHand>{probe};
  }
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (const ScenarioHand& hand : scenario.hands) {
    auto planned = plan_hand(hand, the_case, *instruments, scenario.where);
    if (!planned) return tl::unexpected(planned.error());
    hands.push_back(std::move(*planned));
  }
  return hands;
}

AttemptWatch::AttemptWatch(const ScenarioPlan& plan, const Case& the_case,
                           std::span<const PlannedHand> hands, double tick_s)
    : plan_(&plan),
      case_(&the_case),
      tick_s_(tick_s),
      meter_(tick_s),
      state_(begin_scenario(plan)),
      tells_tips_(asks_for_tip(plan)),
      rings_(the_case, tick_s),
      graft_(the_case) {
  const std::vector<CutPart> parts = cut_parts_of(plan, the_case);
  const std::vector<Portal> portals = portals_of_attempt(plan.scenario, the_case);
  PortalWatch::Settings made;
  for (const Portal& portal : portals) made.marks.push_back(portal.landmark);
  for (const PlannedHand& hand : hands) made.optics.push_back(hand.optics);
  stumps_.emplace(the_case, made.optics);
  portals_.emplace(the_case, std::move(made));
  for (std::size_t h = 0; h < hands.size(); ++h) {
    const auto hand = static_cast<std::uint8_t>(h);
    events_.emplace_back(the_case.bones.size(), event_limits(plan.scenario), hand, tick_s);
    ScopeWatch::Settings settings;
    settings.optics = hands[h].optics;
    settings.portal_W = hands[h].portal_W;
    settings.hand = hand;
    settings.tick_s = tick_s;
    settings.marks = marks_of(plan);
    for (const Portal& portal : portals) settings.portal_marks.push_back(portal.landmark);
    scopes_.emplace_back(the_case, std::move(settings));
    for (const CutPart& part : parts)
      if (hands[h].removes)
        cuts_.push_back({h, CutWatch(the_case, part, hands[h].tip_radius_m, hand, tick_s)});
    pins_.push_back(hands[h].pin);
  }
}

void AttemptWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  if (pauses_.empty() || tools.empty()) return add_counted(tools, bones);
  const PausedTick at = paused_at(pauses_, tools[0]->tick);
  if (at.in_pause) return;
  shifted_.clear();
  for (const ToolState* tool : tools) {
    shifted_.push_back(*tool);
    shifted_.back().tick -= std::min(at.before, tool->tick);
  }
  shifted_tools_.clear();
  for (const ToolState& tool : shifted_) shifted_tools_.push_back(&tool);
  add_counted(shifted_tools_, bones);
}

void AttemptWatch::add_counted(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  fresh_.clear();
  note_held(tools);
  for (std::size_t h = 0; h < std::min(tools.size(), events_.size()); ++h) {
    now_s_ = static_cast<double>(tools[h]->tick) * tick_s_;
    events_[h].add(*tools[h], fresh_);
    const ToolState* other = tools.size() == 2 ? tools[1 - h] : nullptr;
    scopes_[h].add(*tools[h], other, bones, fresh_);
    if (tells_tips_) tell_tip(*tools[h], static_cast<std::uint8_t>(h), tick_s_, fresh_);
  }
  for (HandCut& cut : cuts_)
    if (cut.hand < tools.size()) cut.watch.add(*tools[cut.hand], fresh_);
  rings_.add(tools, bones, fresh_);
  if (tunnels_) graft_.set_room(tunnels_->room());
  if (!tools.empty()) graft_.add(tools[0]->tick, bones, fresh_);
  if (!tools.empty()) placing_.add(tools[0]->tick, bones, fresh_);
  if (!tools.empty()) exam_.add(tools[0]->tick, bones, fresh_);
  skin_.add(tools, bones, fresh_);
  if (portals_) portals_->add(tools, bones, fresh_);
  if (tunnels_) tunnels_->add(tools, bones, fresh_);
  if (water_) water_->add(tools, bones, fresh_);
  if (stumps_) stumps_->add(tools, bones, water_ && water_->is_obscured_now(), fresh_);
  if (sound_parts_) sound_parts_->add(tools, bones, fresh_);
  judge_fresh();
  if (now_s() >= plan_->scenario.time_limit_s) state_.over = true;
  if (!tools.empty() && (!part_ || tools[0]->tick > part_->from_tick)) meter_.add(*tools[0]);
}

void AttemptWatch::note_held(std::span<const ToolState* const> tools) {
  held_.clear();
  for (const ToolState* tool : tools)
    held_.push_back(tool->instrument < tray_.size() ? std::string_view(tray_[tool->instrument])
                                                    : std::string_view());
}

void AttemptWatch::set_part(const AttemptPart& part, PartStages stages) {
  part_ = Part{stages, part.from_tick, static_cast<double>(part.from_tick) * tick_s_};
}

void AttemptWatch::go_back(std::uint32_t mark) {
  const auto kept = marks_.find(mark);
  if (kept == marks_.end() || (part_ && kept->second.stage < part_->stages.first)) return;
  go_back_to(kept->second, state_);
}

double AttemptWatch::now_s() const { return std::max(0.0, now_s_ - part_from_s()); }

std::optional<KneeExam> AttemptWatch::exam() const {
  return asks_for_exam(*plan_) ? std::optional(exam_.exam()) : std::nullopt;
}

void AttemptWatch::watch_tunnels(TunnelSources sources) {
  if (!asks_about_tunnels(*plan_)) return;
  auto widths_m = drilled_widths(sources.tray);
  tunnels_.emplace(*plan_, *case_, std::move(sources), pins_, std::move(widths_m), tick_s_);
}

void AttemptWatch::watch_tray(const std::vector<std::string>& tray) {
  tray_ = tray;
  std::vector<char> needles;
  for (const std::string& name : tray) needles.push_back(name.starts_with(kSpinalNeedle));
  if (portals_) portals_->set_needles(std::move(needles));
  water_ = WaterWatch::of(*case_, tray, tick_s_);
  sound_parts_.emplace(*case_, clearing_tools(tray), tick_s_);
}

Result<Outcome> AttemptWatch::finish(const Standard* standard, const StatedFindings& stated) {
  fresh_.clear();
  for (ToolEvents& events : events_) events.finish(fresh_);
  if (tunnels_) tunnels_->finish(fresh_);
  judge_fresh();
  finish_scenario(*plan_, now_s_, state_, grade_findings(plan_->scenario.asks, *case_, stated));
  auto metrics = meter_.finish();
  if (!metrics) return tl::unexpected(metrics.error());
  if (water_) (*metrics)[kObscuredPercent] = water_->sight().percent();
  auto outcome = outcome_of_all(std::move(*metrics), standard, stated);
  if (outcome && water_) outcome->sight = water_->sight();
  return outcome;
}

// Standards are set for whole exercises.
Result<Outcome> AttemptWatch::outcome_of_all(Metrics metrics, const Standard* standard,
                                             const StatedFindings& stated) const {
  if (!part_) return outcome_of(*plan_, *case_, state_, std::move(metrics), standard, stated);
  const PartOfAttempt part = part_of(*plan_, state_, part_->stages, part_->from_s);
  return outcome_of(part.plan, *case_, part.state, std::move(metrics), nullptr, stated);
}

void AttemptWatch::judge_fresh() {
  for (const Event& event : fresh_) {
    judge(*plan_, event, tick_s_, state_, held_);
    if (part_ && state_.stage > part_->stages.last) state_.over = true;
  }
}

}  // namespace osteon
