#include "rules/placing_rules.h"

#include <string>

#include "osteon/procedure/placing_watch.h"

namespace osteon {
namespace {

constexpr double kMostGap_mm = 1000;

bool placing_goal_met(const PlannedRule& rule, const Event& event) {
  const std::string& kind = rule.rule.kind;
  if (kind == "screw_in") return event.kind == kScrewIn;
  if (kind == "knee_cycled")
    return event.kind == kKneeCycled && event.values[0] >= number_of(rule, "times") &&
           event.values[1] >= number_of(rule, "tension_n");
  if (kind == "thread_laid") return event.kind == kThreadLaid;
  if (kind == "thread_out") return event.kind == kThreadOut;
  return kind == "button_turned" && event.kind == kButtonTurned;
}

bool placing_error_made(const PlannedRule& rule, const Event& event) {
  const std::string& kind = rule.rule.kind;
  if (kind == "thread_lost") return event.kind == kThreadLost;
  if (kind == "button_let_go") return event.kind == kButtonLetGo;
  if (kind == "screw_diverges")
    return event.kind == kScrewIn && event.values[1] > number_of(rule, "most_deg");
  if (kind == "screw_shallow")
    return event.kind == kScrewIn && event.values[0] < number_of(rule, "least_mm");
  if (kind == "tension_outside")
    return event.kind == kScrewIn && (event.values[2] < number_of(rule, "least_n") ||
                                      event.values[2] > number_of(rule, "most_n"));
  if (kind == "cycles_under")
    return event.kind == kGraftFixed && event.values[1] < number_of(rule, "least");
  return event.kind == kButtonTurned && event.values[0] >= number_of(rule, "least_mm") &&
         event.values[0] < number_of(rule, "most_mm");
}

}  // namespace

const std::vector<RuleKind>& placing_rule_table() {
  constexpr SubjectKind kOfNothing = SubjectKind::kNothing;
  static const std::vector<RuleKind> table{
      {"thread_laid",
       "the thread goes through the femur, its end lies in the joint",
       true,
       {},
       kOfNothing},
      {"thread_out", "the thread's end is out through the tibia", true, {}, kOfNothing},
      {"button_turned", "the button lies across its channel", true, {}, kOfNothing},
      {"knee_cycled",
       "the knee was stretched out and bent the given number of times with the graft in it, its "
       "tail pulled",
       true,
       {{"times", 1, 1000, 20}, {"tension_n", 0, 200, 20}},
       kOfNothing},
      {"screw_in", "a screw was turned in beside the graft in the tibia", true, {}, kOfNothing},
      {"screw_diverges",
       "the angle between the screw and the tibial tunnel is more than most_deg",
       false,
       {{"most_deg", 0, 90, 15}},
       kOfNothing},
      {"screw_shallow",
       "the screw was turned in less than least_mm deep",
       false,
       {{"least_mm", 0, 100, 20}},
       kOfNothing},
      {"tension_outside",
       "the pull on the graft's tail was not least_n to most_n when the screw was released",
       false,
       {{"least_n", 0, 200, 40}, {"most_n", 0, 200, 150}},
       kOfNothing},
      {"cycles_under",
       "the knee was bent fewer than least times under tension before the screw",
       false,
       {{"least", 1, 1000, 20}},
       kOfNothing},
      {"thread_lost", "the thread's end was drawn or released out of reach", false, {}, kOfNothing},
      {"button_let_go",
       "the thread was released while the button was in its channel",
       false,
       {},
       kOfNothing},
      {"tissue_under_button",
       "the button turned with least_mm to most_mm of tissue between it and the cortex",
       false,
       {{"least_mm", 0, kMostGap_mm, 1}, {"most_mm", 0, kMostGap_mm, kMostGap_mm}},
       kOfNothing},
  };
  return table;
}

bool step_placing_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                       std::optional<RuleHit>& hit) {
  const RuleKind* kind = nullptr;
  for (const RuleKind& row : placing_rule_table())
    if (row.name == rule.rule.kind) kind = &row;
  if (!kind) return false;
  hit.reset();
  if (kind->is_goal) {
    if (placing_goal_met(rule, event)) state.holds[0].told = true;
    state.met = state.holds[0].told;
  } else if (placing_error_made(rule, event)) {
    hit = RuleHit{time_of(event, tick_s)};
  }
  return true;
}

}  // namespace osteon
