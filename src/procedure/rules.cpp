#include "rules.h"

#include <algorithm>

namespace osteon {
namespace {

using RuleStep = std::optional<RuleHit> (*)(const PlannedRule&, const Event&, std::size_t bone,
                                            double tick_s, RuleState&);

double number_of(const PlannedRule& rule, const char* name) { return rule.rule.numbers.at(name); }

double time_of(const Event& event, double tick_s) {
  return static_cast<double>(event.tick) * tick_s;
}

// A bone counts once a contact has lasted and pressed enough.
std::optional<RuleHit> touched(const PlannedRule& rule, const Event& event, std::size_t bone,
                               double, RuleState& state) {
  if (event.kind != EventKind::kContactEnd) return std::nullopt;
  if (event.values[0] < number_of(rule, "for_s") || event.values[1] < number_of(rule, "force_n"))
    return std::nullopt;
  state.done[bone] = 1;
  return std::nullopt;
}

// The same, but only the first bone that is not done yet counts.
std::optional<RuleHit> touched_in_order(const PlannedRule& rule, const Event& event,
                                        std::size_t bone, double tick_s, RuleState& state) {
  const bool turn = std::all_of(state.done.begin(), state.done.begin() + static_cast<long>(bone),
                                [](char done) { return done != 0; });
  return turn ? touched(rule, event, bone, tick_s, state) : std::nullopt;
}

std::optional<RuleHit> pressed_over(const PlannedRule& rule, const Event& event, std::size_t,
                                    double tick_s, RuleState&) {
  if (event.kind != EventKind::kForceUnder || event.values[1] != number_of(rule, "force_n") ||
      event.values[2] < number_of(rule, "for_s"))
    return std::nullopt;
  return RuleHit{time_of(event, tick_s) - event.values[2]};
}

std::optional<RuleHit> slid_over(const PlannedRule& rule, const Event& event, std::size_t,
                                 double tick_s, RuleState&) {
  if (event.kind != EventKind::kScratch || event.values[0] < number_of(rule, "slide_mm"))
    return std::nullopt;
  return RuleHit{time_of(event, tick_s) - event.values[2]};
}

std::optional<RuleHit> struck(const PlannedRule& rule, const Event& event, std::size_t,
                              double tick_s, RuleState&) {
  if (event.kind != EventKind::kImpact || event.values[0] <= number_of(rule, "speed_mm_s"))
    return std::nullopt;
  return RuleHit{time_of(event, tick_s)};
}

// Says nothing while the attempt runs: finish_scenario looks at which bones were never touched.
std::optional<RuleHit> left_out(const PlannedRule&, const Event& event, std::size_t bone, double,
                                RuleState& state) {
  if (event.kind == EventKind::kContactBegin) state.done[bone] = 1;
  return std::nullopt;
}

struct RuleRow {
  RuleKind kind;
  RuleStep step;
};

const std::vector<RuleRow>& rule_rows() {
  static const std::vector<RuleRow> rows = {
      {{"touched",
        "every bone is touched for a time with a force, in any order",
        true,
        {{"for_s", 0, 60, 0.1}, {"force_n", 0, 20, 0.2}}},
       touched},
      {{"touched_in_order",
        "the same, one after the other as they are listed",
        true,
        {{"for_s", 0, 60, 0.1}, {"force_n", 0, 20, 0.2}}},
       touched_in_order},
      {{"pressed_over",
        "a bone is pressed harder than a limit for a time",
        false,
        {{"force_n", 0.05, 100, 4}, {"for_s", 0, 60, 0.1}}},
       pressed_over},
      {{"slid_over",
        "the tool slides over a bone under a force, farther than a limit",
        false,
        {{"force_n", 0.05, 100, 2}, {"slide_mm", 0.5, 100, 2}}},
       slid_over},
      {{"struck", "a bone is met faster than a limit", false, {{"speed_mm_s", 1, 10000, 60}}},
       struck},
      {{"left_out", "the attempt ends and a bone was never touched", false, {}}, left_out},
  };
  return rows;
}

}  // namespace

const std::vector<RuleKind>& rule_table() {
  static const std::vector<RuleKind> kinds = [] {
    std::vector<RuleKind> all;
    for (const RuleRow& row : rule_rows()) all.push_back(row.kind);
    return all;
  }();
  return kinds;
}

const RuleKind* find_rule_kind(std::string_view name) {
  for (const RuleKind& kind : rule_table())
    if (kind.name == name) return &kind;
  return nullptr;
}

std::optional<RuleHit> step_rule(const PlannedRule& rule, const Event& event, double tick_s,
                                 RuleState& state) {
  if (event.subject_kind != SubjectKind::kBone) return std::nullopt;
  const auto bone = std::find(rule.bones.begin(), rule.bones.end(), event.subject);
  if (bone == rule.bones.end()) return std::nullopt;
  for (const RuleRow& row : rule_rows()) {
    if (row.kind.name != rule.rule.kind) continue;
    const auto place = static_cast<std::size_t>(bone - rule.bones.begin());
    const auto hit = row.step(rule, event, place, tick_s, state);
    state.met = std::all_of(state.done.begin(), state.done.end(), [](char d) { return d != 0; });
    return hit;
  }
  return std::nullopt;
}

}  // namespace osteon
