#include "rules/exam_rules.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/knee_exam_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

// Bits of the tests that were done.
constexpr double kBoth = 3;

double with_test(double done, const Event& event) {
  const bool lachman = event.values[0] == 0;
  const bool has = lachman ? done == 1 || done == kBoth : done >= 2;
  return has ? done : done + (lachman ? 1 : 2);
}

}  // namespace

const std::vector<RuleKind>& exam_rule_table() {
  static const std::vector<RuleKind> table{
      {"knee_examined",
       "Lachman and pivot shift were both tested by hand, on the knee as it was found (grafted 0) "
       "or with its fixed graft (1)",
       true,
       {{"grafted", 0, 1, 0}},
       SubjectKind::kNothing,
       kKneeExamined},
      {"knee_bent",
       "the knee stands still, bent as far as is asked for",
       true,
       {{"to_deg", 0, 160, 90}, {"within_deg", 0.5, 90, 5}},
       SubjectKind::kNothing,
       kKneeBent},
      {"unexamined",
       "a tunnel is begun before Lachman and pivot shift were both tested by hand",
       false,
       {},
       SubjectKind::kNothing,
       kKneeExamined,
       false,
       kTunnelBegun},
  };
  return table;
}

// `most` of the hold says which tests were done.
bool step_exam_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                    std::optional<RuleHit>& hit) {
  const auto& table = exam_rule_table();
  const auto kind = std::find_if(table.begin(), table.end(),
                                 [&](const RuleKind& k) { return k.name == rule.rule.kind; });
  if (kind == table.end()) return false;
  hit.reset();
  if (kind->name == "knee_bent") {
    if (event.kind == kKneeBent &&
        std::abs(event.values[0] - number_of(rule, "to_deg")) <= number_of(rule, "within_deg"))
      state.met = true;
    return true;
  }
  RuleHold& hold = state.holds[0];
  const double knee = kind->is_goal ? number_of(rule, "grafted") : 0;
  if (event.kind == kKneeExamined && event.values[1] == knee)
    hold.most = with_test(hold.most, event);
  if (kind->is_goal) {
    state.met = hold.most == kBoth;
  } else if (event.kind == kTunnelBegun && !hold.told && hold.most != kBoth) {
    hold.told = true;
    hit = RuleHit{time_of(event, tick_s)};
  }
  return true;
}

}  // namespace osteon
