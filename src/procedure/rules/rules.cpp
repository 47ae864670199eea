#include "rules/rules.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/cut_watch.h"
#include "osteon/procedure/ring_watch.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/procedure/sight_events.h"
#include "osteon/procedure/tip_watch.h"
#include "rules/exam_rules.h"
#include "rules/graft_rules.h"
#include "rules/placing_rules.h"
#include "rules/portal_rules.h"
#include "rules/ring_rules.h"
#include "rules/skin_rules.h"
#include "rules/stump_rules.h"
#include "rules/tunnel_rules.h"
#include "rules/way_rules.h"

namespace osteon {

double number_of(const PlannedRule& rule, const char* name) { return rule.rule.numbers.at(name); }

double time_of(const Event& event, double tick_s) {
  return static_cast<double>(event.tick) * tick_s;
}

std::optional<RuleHit> lasting(bool wrong, const PlannedRule& rule, const Event& event,
                               double tick_s, RuleHold& hold) {
  const double now_s = time_of(event, tick_s);
  if (!wrong) {
    hold.since_s = -1;
    hold.told = false;
    return std::nullopt;
  }
  if (hold.since_s < 0) hold.since_s = now_s;
  if (hold.told || now_s - hold.since_s < number_of(rule, "for_s")) return std::nullopt;
  hold.told = true;
  return RuleHit{hold.since_s};
}

namespace {

using RuleStep = std::optional<RuleHit> (*)(const PlannedRule&, const Event&, std::size_t bone,
                                            double tick_s, RuleState&);

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

// Says nothing while the attempt runs: finish_scenario looks at what was stated.
std::optional<RuleHit> judged_at_end(const PlannedRule&, const Event&, std::size_t, double,
                                     RuleState&) {
  return std::nullopt;
}

// A mark counts once it has been seen in this way for long enough, without a break.
std::optional<RuleHit> seen(const PlannedRule& rule, const Event& event, std::size_t mark,
                            double tick_s, RuleState& state) {
  if (event.kind != kMarkSeen) return std::nullopt;
  constexpr double kBreak_s = 0.03;
  RuleHold& hold = state.holds[mark];
  const double now_s = time_of(event, tick_s), mm = event.values[1];
  const bool fits = event.values[0] <= number_of(rule, "central") &&
                    mm >= number_of(rule, "near_mm") && mm <= number_of(rule, "far_mm") &&
                    std::abs(event.values[2]) <= number_of(rule, "level_deg");
  if (!fits || now_s - hold.last_s > kBreak_s) hold.since_s = -1;
  hold.last_s = now_s;
  if (!fits) return std::nullopt;
  if (hold.since_s < 0) hold = {now_s, now_s, mm, mm, false, false};
  hold.least = std::min(hold.least, mm);
  hold.most = std::max(hold.most, mm);
  if (now_s - hold.since_s >= number_of(rule, "for_s") &&
      hold.most - hold.least >= number_of(rule, "span_mm"))
    state.done[mark] = 1;
  return std::nullopt;
}

std::optional<RuleHit> seen_in_order(const PlannedRule& rule, const Event& event, std::size_t mark,
                                     double tick_s, RuleState& state) {
  const bool turn = std::all_of(state.done.begin(), state.done.begin() + static_cast<long>(mark),
                                [](char done) { return done != 0; });
  return turn ? seen(rule, event, mark, tick_s, state) : std::nullopt;
}

// A portal counts once the shaft has been in it for long enough, without a break.
std::optional<RuleHit> through(const PlannedRule& rule, const Event& event, std::size_t portal,
                               double tick_s, RuleState& state) {
  constexpr double kBreak_s = 0.03;
  if (event.kind != kThroughPortal) return std::nullopt;
  RuleHold& hold = state.holds[portal];
  const double now_s = time_of(event, tick_s);
  if (hold.since_s < 0 || now_s - hold.last_s > kBreak_s) hold.since_s = now_s;
  hold.last_s = now_s;
  if (now_s - hold.since_s >= number_of(rule, "for_s")) state.done[portal] = 1;
  return std::nullopt;
}

std::optional<RuleHit> tilted(const PlannedRule& rule, const Event& event, std::size_t,
                              double tick_s, RuleState& state) {
  if (event.kind != kScopeHeld) return std::nullopt;
  const bool wrong = std::abs(event.values[0]) > number_of(rule, "level_deg");
  return lasting(wrong, rule, event, tick_s, state.holds[0]);
}

// Out of the picture for a time, from when it has been in it for the first time.
std::optional<RuleHit> lost(bool in_picture, const PlannedRule& rule, const Event& event,
                            double tick_s, RuleHold& hold) {
  hold.armed = hold.armed || in_picture;
  return lasting(hold.armed && !in_picture, rule, event, tick_s, hold);
}

std::optional<RuleHit> nothing_seen(const PlannedRule& rule, const Event& event, std::size_t,
                                    double tick_s, RuleState& state) {
  if (event.kind != kScopeHeld) return std::nullopt;
  return lost(event.values[1] > 0, rule, event, tick_s, state.holds[0]);
}

// The time in which nobody looks does not count.
std::optional<RuleHit> obscured(const PlannedRule& rule, const Event& event, std::size_t,
                                double tick_s, RuleState& state) {
  return lasting(event.values[0] > 0, rule, event, tick_s, state.holds[0]);
}

std::optional<RuleHit> off_portal(const PlannedRule& rule, const Event& event, std::size_t,
                                  double tick_s, RuleState& state) {
  if (event.kind != kShaftHeld) return std::nullopt;
  return lasting(event.values[0] > number_of(rule, "off_mm"), rule, event, tick_s, state.holds[0]);
}

std::optional<RuleHit> tip_unseen(const PlannedRule& rule, const Event& event, std::size_t,
                                  double tick_s, RuleState& state) {
  if (event.kind != kTipSeen) return std::nullopt;
  return lost(event.values[0] > 0, rule, event, tick_s, state.holds[0]);
}

struct RuleRow {
  RuleKind kind;
  RuleStep step;
};

std::vector<RuleNumber> seen_numbers() {
  return {{"for_s", 0, 60, 1.5},    {"central", 0.01, 1, 0.5},    {"near_mm", 0, 500, 3},
          {"far_mm", 0.1, 500, 15}, {"level_deg", 0.5, 180, 180}, {"span_mm", 0, 500, 0}};
}

const std::vector<RuleRow>& rule_rows() {
  static const std::vector<RuleRow> rows = {
      {{"touched",
        "every bone is touched for a time with a force, in any order",
        true,
        {{"for_s", 0, 60, 0.1}, {"force_n", 0, 20, 0.2}}},
       touched},
      {{"touched_in_order",
        "the same, in the listed order",
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
      {{"struck", "a bone is hit faster than a limit", false, {{"speed_mm_s", 1, 10000, 60}}},
       struck},
      {{"left_out", "the attempt ends before every bone was touched", false, {}}, left_out},
      {{"fault_missed",
        "the attempt ends, and a finding that is asked for was not stated as it is",
        false,
        {},
        SubjectKind::kNothing},
       judged_at_end},
      {{"sound_blamed",
        "the attempt ends, and something that is asked for and is sound was stated as faulty",
        false,
        {},
        SubjectKind::kNothing},
       judged_at_end},
      {{"seen",
        "every mark is seen near the middle of the picture, from a suitable distance and not "
        "hidden",
        true, seen_numbers(), SubjectKind::kLandmark},
       seen},
      {{"seen_in_order", "the same, in the listed order", true, seen_numbers(),
        SubjectKind::kLandmark},
       seen_in_order},
      {{"through",
        "the shaft passes through every one of these portals for a time",
        true,
        {{"for_s", 0, 60, 0.5}},
        SubjectKind::kLandmark},
       through},
      {{"tilted",
        "the picture is tilted by more than a limit for a time",
        false,
        {{"level_deg", 1, 179, 15}, {"for_s", 0, 60, 2}},
        SubjectKind::kNothing},
       tilted},
      {{"nothing_seen",
        "no mark is in the picture for a time",
        false,
        {{"for_s", 0, 60, 3}},
        SubjectKind::kNothing},
       nothing_seen},
      {{"obscured",
        "blood, debris or too little pressure hides everything from the scope for a time",
        false,
        {{"for_s", 0, 600, 10}},
        SubjectKind::kNothing,
        kWaterLooked},
       obscured},
      {{"off_portal",
        "the shaft leans out of its portal for a time",
        false,
        {{"off_mm", 0.5, 100, 4}, {"for_s", 0, 60, 0.3}},
        SubjectKind::kNothing},
       off_portal},
      {{"tip_unseen",
        "the tip of the other hand is out of the picture, or hidden, for a time",
        false,
        {{"for_s", 0, 60, 1}},
        SubjectKind::kNothing},
       tip_unseen},
      {{"reached_in_order",
        "the tip reaches every mark and stays for a time, in the listed order",
        true,
        {{"near_mm", 0.2, 100, 2}, {"for_s", 0, 60, 0}},
        SubjectKind::kLandmark,
        kTipAt},
       reached_in_order},
      {{"passed_in_order",
        "the tip goes in at the first mark of each pair and comes out at the second, pair by pair",
        true,
        {{"near_mm", 0.2, 100, 3}, {"for_s", 0, 60, 0}},
        SubjectKind::kLandmark,
        kTipAt},
       passed_in_order},
      {{"removed",
        "this share of the bone beside the line through the marks is removed",
        true,
        {{"within_mm", 0.2, 100, 3}, {"share", 0.01, 1, 0.9}, {"for_s", 0, 60, 0}},
        SubjectKind::kLandmark,
        kCutSeen,
        true},
       removed},
      {{"strayed",
        "between the first and the last mark, the tip is farther than a limit from the path "
        "through the marks for a time",
        false,
        {{"off_mm", 0.2, 100, 3}, {"for_s", 0, 60, 0.2}},
        SubjectKind::kLandmark,
        kTipAt},
       strayed},
      {{"passed_out_of_order",
        "the tip goes through a pair of marks before an earlier pair",
        false,
        {{"near_mm", 0.2, 100, 3}},
        SubjectKind::kLandmark,
        kTipAt},
       passed_out_of_order},
      {{"cut_outside",
        "bone is removed farther outside the intended region than a limit",
        false,
        {{"beyond_mm", 0.1, 100, 1}},
        SubjectKind::kNothing,
        kCutSeen},
       cut_outside},
      {{"ringed",
        "a loose ring is placed on the peg of every mark, in any order",
        true,
        {{"near_mm", 0.2, 100, 3}},
        SubjectKind::kLandmark,
        kRingMoved},
       ringed},
      {{"ring_dropped",
        "a loose ring is left anywhere but on a peg",
        false,
        {},
        SubjectKind::kNothing,
        kRingMoved},
       ring_dropped},
  };
  return rows;
}

}  // namespace

const std::vector<RuleKind>& rule_table() {
  static const std::vector<RuleKind> kinds = [] {
    std::vector<RuleKind> all;
    for (const RuleRow& row : rule_rows()) all.push_back(row.kind);
    all.insert(all.end(), tunnel_rule_table().begin(), tunnel_rule_table().end());
    all.insert(all.end(), graft_rule_table().begin(), graft_rule_table().end());
    all.insert(all.end(), placing_rule_table().begin(), placing_rule_table().end());
    all.insert(all.end(), stump_rule_table().begin(), stump_rule_table().end());
    all.insert(all.end(), portal_rule_table().begin(), portal_rule_table().end());
    all.insert(all.end(), skin_rule_table().begin(), skin_rule_table().end());
    all.insert(all.end(), exam_rule_table().begin(), exam_rule_table().end());
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
  if (!rule.applies) return std::nullopt;
  const bool of_kind = rule.heeds != EventKind::kNone;
  const bool heeded = event.kind == rule.heeds ||
                      (rule.heeds_too != EventKind::kNone && event.kind == rule.heeds_too);
  if (of_kind ? !heeded : event.subject_kind != rule.about) return std::nullopt;
  if (rule.hand != kNoHand && event.hand != rule.hand) return std::nullopt;
  const auto bone =
      of_kind ? rule.bones.begin() : std::find(rule.bones.begin(), rule.bones.end(), event.subject);
  if (!of_kind && rule.about != SubjectKind::kNothing && bone == rule.bones.end())
    return std::nullopt;
  const auto place = static_cast<std::size_t>(bone - rule.bones.begin());
  std::optional<RuleHit> tunnel_hit;
  if (step_tunnel_rule(rule, event, place, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_graft_rule(rule, event, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_placing_rule(rule, event, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_stump_rule(rule, event, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_portal_rule(rule, event, place, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_skin_rule(rule, event, tick_s, state, tunnel_hit)) return tunnel_hit;
  if (step_exam_rule(rule, event, tick_s, state, tunnel_hit)) return tunnel_hit;
  for (const RuleRow& row : rule_rows()) {
    if (row.kind.name != rule.rule.kind) continue;
    const auto hit = row.step(rule, event, place, tick_s, state);
    state.met = std::all_of(state.done.begin(), state.done.end(), [](char d) { return d != 0; });
    return hit;
  }
  return std::nullopt;
}

}  // namespace osteon
