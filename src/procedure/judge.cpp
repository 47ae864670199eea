#include "osteon/procedure/judge.h"

#include <algorithm>

#include "rules/rule_instruments.h"
#include "rules/rules.h"

namespace osteon {
namespace {

Result<PlannedRule> plan_marks(PlannedRule planned, const Scenario& scenario,
                               const Case& the_case) {
  for (const std::string& name : planned.rule.marks) {
    const auto mark = find_landmark(the_case, name);
    if (!mark)
      return fail("the case '" + the_case.name + "' has no landmark '" + name + "'",
                  scenario.where + ":" + std::to_string(planned.rule.line),
                  "Name a landmark of the case's description");
    planned.bones.push_back(*mark);
    planned.places_W.push_back(the_case.landmarks[*mark].p_W);
  }
  for (const std::string& name : planned.rule.subjects)
    if (!the_case.find(name).valid())
      return fail("the case '" + the_case.name + "' has no bone '" + name + "'",
                  scenario.where + ":" + std::to_string(planned.rule.line),
                  "Name its bones as `osteon case info` does");
  return planned;
}

// `finding`: "old_tunnel=sound".
bool has_finding(const Case& the_case, const std::string& finding) {
  return std::any_of(
      the_case.findings.begin(), the_case.findings.end(),
      [&](const CaseFinding& found) { return found.name + "=" + found.grade == finding; });
}

Result<PlannedRule> plan_rule(const Rule& rule, const Scenario& scenario, const Case& the_case) {
  const RuleKind* kind = find_rule_kind(rule.kind);
  PlannedRule planned{rule, {}, kind ? kind->about : SubjectKind::kBone, kNoHand};
  if (kind) planned.heeds = kind->heeds;
  if (kind) planned.heeds_too = kind->heeds_too;
  planned.applies = (rule.when.empty() || has_finding(the_case, rule.when)) &&
                    (rule.unless.empty() || !has_finding(the_case, rule.unless));
  for (std::size_t h = 0; h < scenario.hands.size(); ++h)
    if (scenario.hands[h].name == rule.hand) planned.hand = static_cast<std::uint8_t>(h);
  if (!rule.hand.empty() && planned.hand == kNoHand)
    return fail("the scenario has no hand '" + rule.hand + "'",
                scenario.where + ":" + std::to_string(rule.line), "Name one of its [[hands]]");
  for (const std::string& instrument : rule.instruments)
    if (!is_in_tray(scenario, rule, instrument))
      return fail("no hand that is meant may take '" + instrument + "'",
                  scenario.where + ":" + std::to_string(rule.line),
                  "Name an instrument of its [[hands]], without a size");
  if (planned.about == SubjectKind::kLandmark) return plan_marks(planned, scenario, the_case);
  if (planned.about == SubjectKind::kNothing) return planned;
  for (const std::string& name : rule.subjects) {
    const BoneId bone = the_case.find(name);
    if (!bone.valid())
      return fail("the case '" + the_case.name + "' has no bone '" + name + "'",
                  scenario.where + ":" + std::to_string(rule.line),
                  "Name its bones as `osteon case info` does");
    planned.bones.push_back(bone.index);
  }
  if (rule.subjects.empty())
    for (std::uint32_t i = 0; i < the_case.bones.size(); ++i) planned.bones.push_back(i);
  return planned;
}

RuleState fresh_state(const PlannedRule& rule) {
  return {std::vector<char>(rule.bones.size(), 0), !rule.applies,
          std::vector<RuleHold>(std::max<std::size_t>(1, rule.bones.size()))};
}

void enter_stage(const ScenarioPlan& plan, ScenarioState& state) {
  state.goals.clear();
  if (state.stage >= plan.goals.size()) {
    state.over = true;
    return;
  }
  for (const PlannedRule& goal : plan.goals[state.stage]) state.goals.push_back(fresh_state(goal));
}

void note_error(const ScenarioPlan& plan, std::size_t error, double at_s, const Event& event,
                ScenarioState& state) {
  const std::uint32_t bone = event.subject_kind == SubjectKind::kBone ? event.subject : kNoSubject;
  state.errors.push_back({static_cast<std::uint32_t>(error), at_s, event.hand, bone});
  if (plan.scenario.errors[error].severity == Severity::kCritical) state.over = true;
}

bool is_sound(const std::string& grade) { return grade == kSoundGrade || grade == kNoFinding; }

bool is_stated_wrongly(const PlannedRule& rule, const GradedFinding& finding) {
  const bool sound = is_sound(finding.truth);
  if (rule.rule.kind == "fault_missed") return !sound && !finding.right();
  if (rule.rule.kind == "sound_blamed")
    return sound && !finding.stated.empty() && !is_sound(finding.stated);
  return false;
}

}  // namespace

std::optional<std::uint32_t> find_landmark(const Case& the_case, std::string_view name) {
  for (std::uint32_t i = 0; i < the_case.landmarks.size(); ++i)
    if (the_case.landmarks[i].name == name) return i;
  return std::nullopt;
}

Result<ScenarioPlan> plan_scenario(const Scenario& scenario, const Case& the_case) {
  ScenarioPlan plan{scenario, {}, {}};
  for (const ScenarioStage& stage : scenario.stages) {
    plan.goals.emplace_back();
    for (const Rule& goal : stage.goals) {
      auto planned = plan_rule(goal, scenario, the_case);
      if (!planned) return tl::unexpected(planned.error());
      plan.goals.back().push_back(std::move(*planned));
    }
  }
  for (const ScenarioError& error : scenario.errors) {
    auto planned = plan_rule(error.rule, scenario, the_case);
    if (!planned) return tl::unexpected(planned.error());
    plan.errors.push_back(std::move(*planned));
  }
  return plan;
}

ToolEventLimits event_limits(const Scenario& scenario) {
  ToolEventLimits limits;
  for (const ScenarioError& error : scenario.errors) {
    if (error.rule.kind == "pressed_over") {
      const double force_n = error.rule.numbers.at("force_n");
      if (std::find(limits.force_n.begin(), limits.force_n.end(), force_n) == limits.force_n.end())
        limits.force_n.push_back(force_n);
    }
    if (error.rule.kind == "slid_over") limits.slide_force_n = error.rule.numbers.at("force_n");
  }
  return limits;
}

ScenarioState begin_scenario(const ScenarioPlan& plan) {
  ScenarioState state;
  state.completed_s.assign(plan.goals.size(), -1);
  enter_stage(plan, state);
  for (const PlannedRule& error : plan.errors) state.error_rules.push_back(fresh_state(error));
  return state;
}

void judge(const ScenarioPlan& plan, const Event& event, double tick_s, ScenarioState& state,
           std::span<const std::string_view> held) {
  const std::string_view with = event.hand < held.size() ? held[event.hand] : std::string_view();
  if (state.over) return;
  for (std::size_t i = 0; i < plan.errors.size(); ++i)
    if (is_of(plan.errors[i].rule, with))
      if (const auto hit = step_rule(plan.errors[i], event, tick_s, state.error_rules[i]))
        note_error(plan, i, hit->at_s, event, state);
  if (state.over) return;
  const auto& goals = plan.goals[state.stage];
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (is_of(goals[i].rule, with)) step_rule(goals[i], event, tick_s, state.goals[i]);
  const bool done = std::all_of(state.goals.begin(), state.goals.end(),
                                [](const RuleState& goal) { return goal.met; });
  if (!done) return;
  state.completed_s[state.stage] = static_cast<double>(event.tick) * tick_s;
  ++state.stage;
  enter_stage(plan, state);
}

void go_back_to(const ScenarioState& kept, ScenarioState& state) {
  if (state.over) return;
  state.stage = kept.stage;
  state.goals = kept.goals;
  state.completed_s = kept.completed_s;
}

void finish_scenario(const ScenarioPlan& plan, double at_s, ScenarioState& state,
                     const std::vector<GradedFinding>& graded) {
  state.over = true;
  for (std::size_t i = 0; i < plan.errors.size(); ++i)
    for (const GradedFinding& finding : graded)
      if (is_stated_wrongly(plan.errors[i], finding))
        state.errors.push_back({static_cast<std::uint32_t>(i), at_s, 0, kNoSubject});
  for (std::size_t i = 0; i < plan.errors.size(); ++i) {
    if (plan.errors[i].rule.kind != "left_out") continue;
    for (std::size_t b = 0; b < plan.errors[i].bones.size(); ++b) {
      if (state.error_rules[i].done[b]) continue;
      state.errors.push_back({static_cast<std::uint32_t>(i), at_s, 0, plan.errors[i].bones[b]});
    }
  }
}

}  // namespace osteon
