#include "rules/portal_rules.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/portal_watch.h"

namespace osteon {
namespace {

constexpr double kAnywhere_mm = 100;

bool is_outside(const PlannedRule& rule, const Event& event) {
  const double up_mm = event.values[0], middle_mm = event.values[1];
  return up_mm > number_of(rule, "up_mm") || -up_mm > number_of(rule, "down_mm") ||
         middle_mm > number_of(rule, "middle_mm") || -middle_mm > number_of(rule, "aside_mm");
}

bool is_wrong(const PlannedRule& rule, const Event& event) {
  const std::string& kind = rule.rule.kind;
  if (kind == "portal_outside") return event.kind == kPortalPlaced && is_outside(rule, event);
  if (event.kind != kPortalWay) return false;
  return kind == "portal_pierced" ? event.values[0] > 0 : !(event.values[1] > 0);
}

}  // namespace

const std::vector<RuleKind>& portal_rule_table() {
  static const std::vector<RuleKind> table{
      {"portal_made",
       "a portal is made within a distance of every one of these marks",
       true,
       {{"within_mm", 0.5, 50, 5}},
       SubjectKind::kLandmark},
      {"needle_in",
       "a needle is in the joint, its hole within a distance of every one of these marks, and a "
       "scope in a portal sees its tip",
       true,
       {{"within_mm", 0.5, 50, 5}},
       SubjectKind::kLandmark},
      {"portal_outside",
       "a portal is made farther from its mark than a limit: towards the trunk, the foot, the "
       "middle of the knee or its side",
       false,
       {{"up_mm", 0, kAnywhere_mm, kAnywhere_mm},
        {"down_mm", 0, kAnywhere_mm, kAnywhere_mm},
        {"middle_mm", 0, kAnywhere_mm, kAnywhere_mm},
        {"aside_mm", 0, kAnywhere_mm, kAnywhere_mm}},
       SubjectKind::kLandmark},
      {"portal_pierced",
       "a portal is made by force, without a cut through which the shaft fits",
       false,
       {},
       SubjectKind::kLandmark},
      {"portal_unseen",
       "a portal is made while no scope in another portal sees the tip",
       false,
       {},
       SubjectKind::kLandmark},
  };
  return table;
}

bool step_portal_rule(const PlannedRule& rule, const Event& event, std::size_t place, double tick_s,
                      RuleState& state, std::optional<RuleHit>& hit) {
  const auto& table = portal_rule_table();
  const auto kind = std::find_if(table.begin(), table.end(),
                                 [&](const RuleKind& k) { return k.name == rule.rule.kind; });
  if (kind == table.end()) return false;
  hit.reset();
  if (!kind->is_goal) {
    if (is_wrong(rule, event)) hit = RuleHit{time_of(event, tick_s)};
    return true;
  }
  const bool needle = kind->name == "needle_in";
  const bool counts =
      needle ? event.kind == kNeedleIn && event.values[2] > 0 : event.kind == kPortalPlaced;
  if (counts && std::hypot(event.values[0], event.values[1]) <= number_of(rule, "within_mm"))
    state.done[place] = 1;
  state.met = std::all_of(state.done.begin(), state.done.end(), [](char d) { return d != 0; });
  return true;
}

}  // namespace osteon
