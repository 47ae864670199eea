#include "rules/skin_rules.h"

#include <algorithm>

#include "osteon/procedure/skin_watch.h"

namespace osteon {

const std::vector<RuleKind>& skin_rule_table() {
  static const std::vector<RuleKind> table{
      {"skin_opened",
       "skin that is there for no portal is cut open over a length, in one stroke or in several",
       true,
       {{"least_mm", 5, 100, 25}},
       SubjectKind::kNothing,
       kSkinOpened},
      {"skin_opened_aside",
       "a blade cuts such skin farther from its middle than this, across the limb",
       false,
       {{"most_mm", 0, 100, 12}},
       SubjectKind::kNothing,
       kSkinOpened},
      {"skin_opened_deep",
       "a blade went farther than this beyond the fat under such skin, into tendon or bone",
       false,
       {{"most_mm", 0, 100, 1}},
       SubjectKind::kNothing,
       kSkinOpened},
  };
  return table;
}

bool step_skin_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                    std::optional<RuleHit>& hit) {
  const auto& table = skin_rule_table();
  const auto kind = std::find_if(table.begin(), table.end(),
                                 [&](const RuleKind& k) { return k.name == rule.rule.kind; });
  if (kind == table.end()) return false;
  hit.reset();
  if (kind->is_goal) {
    state.met = state.met || event.values[0] >= number_of(rule, "least_mm");
    return true;
  }
  const double off_mm = event.values[kind->name == "skin_opened_aside" ? 1 : 2];
  if (off_mm > number_of(rule, "most_mm")) hit = RuleHit{time_of(event, tick_s)};
  return true;
}

}  // namespace osteon
