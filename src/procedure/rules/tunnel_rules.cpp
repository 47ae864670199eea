#include "rules/tunnel_rules.h"

#include <array>
#include <cmath>
#include <string>

#include "osteon/procedure/scope_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

constexpr std::size_t kFixedKinds = 10;
constexpr double kMost = 1000;

// Names of the rules about measures live as long as the program.
const std::array<std::string, kTunnelValueNames.size()>& outside_names() {
  static const auto names = [] {
    std::array<std::string, kTunnelValueNames.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = "outside_" + std::string(kTunnelValueNames[i]);
    return all;
  }();
  return names;
}

std::vector<RuleKind> make_table() {
  std::vector<RuleKind> table{
      {"felt",
       "a tool presses with a force next to every mark",
       true,
       {{"within_mm", 0.5, 50, 6}, {"force_n", 0, 20, 0.2}},
       SubjectKind::kLandmark},
      {"tunnel_located",
       "a pin is pressed on every bone and held still; its line becomes the axis of a tunnel",
       true,
       {{"force_n", 0.05, 20, 0.3},
        {"for_s", 0, 60, 1},
        {"depth_mm", 0, 200, 0},
        {"reamed_mm", 1, 20, 8}}},
      {"graft_tested",
       "a graft between both tunnels is tested, and its Lachman is that of the intact knee, or "
       "nearly",
       true,
       {{"most_difference_mm", 0, 100, 3}},
       SubjectKind::kNothing},
      {"entered_by", "a shaft is in one of these portals", false, {}, SubjectKind::kLandmark},
      {"located_unseen",
       "a tunnel is located before these marks were seen",
       false,
       {{"central", 0.01, 1, 0.6}, {"far_mm", 0.1, 500, 30}},
       SubjectKind::kLandmark},
      {"tunnel_drilled",
       "a tunnel was drilled through every bone, measured from what is left of it",
       true,
       {{"least_mm", 0, 200, 15}, {"wide_mm", 1, 20, 7}}},
      {"socket_drilled",
       "a socket was drilled in every bone, and a channel from it to the far side",
       true,
       {{"least_mm", 0, 200, 10}, {"wide_mm", 1, 20, 7}, {"channel_mm", 0, 20, 4.2}}},
      {"drilled_free", "a drill works in one of these bones without a pin", false, {}},
      {"plunged_past",
       "a drill under power goes farther beyond one of these bones",
       false,
       {{"most_mm", 0, 200, 10}}},
      {"drilled_into", "a drill goes 3 mm into one of these bones", false, {}},
  };
  for (const std::string& name : outside_names())
    table.push_back({name,
                     "the named value is measured and is outside the range from least to most",
                     false,
                     {{"least", -kMost, kMost, -kMost}, {"most", -kMost, kMost, kMost}},
                     SubjectKind::kNothing});
  return table;
}

RuleHit now(const Event& event, double tick_s) {
  return RuleHit{static_cast<double>(event.tick) * tick_s};
}

bool is_seen(const PlannedRule& rule, const Event& event) {
  return event.kind == kMarkSeen && event.values[0] <= rule.rule.numbers.at("central") &&
         event.values[1] <= rule.rule.numbers.at("far_mm");
}

// One error for all the marks that were left out.
std::optional<RuleHit> located_unseen(const PlannedRule& rule, const Event& event,
                                      std::size_t place, double tick_s, RuleState& state) {
  if (is_seen(rule, event)) state.done[place] = 1;
  if (event.kind != kTunnelBegun || state.done[place] || state.holds[0].told) return std::nullopt;
  state.holds[0].told = true;
  return now(event, tick_s);
}

// Once for each bone.
std::optional<RuleHit> drill_went_wrong(const PlannedRule& rule, const Event& event,
                                        std::size_t place, double tick_s, RuleState& state) {
  const bool past = rule.rule.kind == "plunged_past", into = rule.rule.kind == "drilled_into";
  const EventKind heeded = past ? kDrillPlunged : into ? kBoneDrilled : kDrilledFree;
  if (event.kind != heeded || state.holds[place].told) return std::nullopt;
  if (past && event.values[0] <= rule.rule.numbers.at("most_mm")) return std::nullopt;
  state.holds[place].told = true;
  return now(event, tick_s);
}

// Once for each portal, however long the shaft stays.
std::optional<RuleHit> entered_by(const Event& event, std::size_t place, double tick_s,
                                  RuleState& state) {
  if (event.kind != kThroughPortal || state.holds[place].told) return std::nullopt;
  state.holds[place].told = true;
  return now(event, tick_s);
}

std::optional<RuleHit> outside(std::size_t which, const PlannedRule& rule, const Event& event,
                               double tick_s) {
  if (event.kind != kTunnelMeasured || event.values[0] != static_cast<double>(which))
    return std::nullopt;
  const double value = event.values[1];
  if (value >= rule.rule.numbers.at("least") && value <= rule.rule.numbers.at("most"))
    return std::nullopt;
  return now(event, tick_s);
}

void step_goal(const PlannedRule& rule, const Event& event, std::size_t place, RuleState& state) {
  const auto& n = rule.rule.numbers;
  const std::string& kind = rule.rule.kind;
  if (kind == "felt" && event.kind == kMarkFelt && event.values[0] <= n.at("within_mm") &&
      event.values[1] >= n.at("force_n"))
    state.done[place] = 1;
  const auto& v = event.values;
  if (kind == "tunnel_drilled" && event.kind == kTunnelDrilled)
    state.done[place] = v[0] >= n.at("least_mm") && v[1] >= n.at("wide_mm") && v[2] > 0;
  if (kind == "socket_drilled" && event.kind == kSocketDrilled)
    state.done[place] =
        v[0] >= n.at("least_mm") && v[1] >= n.at("wide_mm") && v[2] >= n.at("channel_mm");
  if (kind == "tunnel_located" && event.kind == kTunnelLocated) state.done[place] = 1;
  // A rule about no subject has none that could be done: it holds by its hold.
  if (kind == "graft_tested" && event.kind == kGraftTested &&
      event.values[0] <= n.at("most_difference_mm"))
    state.holds[0].told = true;
}

}  // namespace

const std::vector<RuleKind>& tunnel_rule_table() {
  static const std::vector<RuleKind> table = make_table();
  return table;
}

bool step_tunnel_rule(const PlannedRule& rule, const Event& event, std::size_t place, double tick_s,
                      RuleState& state, std::optional<RuleHit>& hit) {
  const auto& table = tunnel_rule_table();
  std::size_t kind = 0;
  while (kind < table.size() && table[kind].name != rule.rule.kind) ++kind;
  if (kind == table.size()) return false;
  hit.reset();
  if (kind >= kFixedKinds)
    hit = outside(kind - kFixedKinds, rule, event, tick_s);
  else if (table[kind].is_goal)
    step_goal(rule, event, place, state);
  else if (rule.rule.kind == "located_unseen")
    hit = located_unseen(rule, event, place, tick_s, state);
  else if (rule.rule.kind == "entered_by")
    hit = entered_by(event, place, tick_s, state);
  else
    hit = drill_went_wrong(rule, event, place, tick_s, state);
  state.met = true;
  for (const char done : state.done) state.met = state.met && done != 0;
  if (state.done.empty()) state.met = state.holds[0].told;
  return true;
}

}  // namespace osteon
