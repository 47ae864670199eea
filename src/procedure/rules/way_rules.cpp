#include "rules/way_rules.h"

#include <algorithm>
#include <span>

#include "osteon/procedure/polyline.h"
#include "path_units.h"

namespace osteon {
namespace {

// The first pair that is not done yet; as many as there are pairs: none.
std::size_t first_open_pair(const RuleState& state) {
  std::size_t pair = 0;
  while (2 * pair + 1 < state.done.size() && state.done[2 * pair + 1]) ++pair;
  return pair;
}

// Whether the tip has just come out of a pair that it had gone into. `armed`: it is on its way;
// `least`: how far it was past the first plane, m.
bool comes_through(const PlannedRule& rule, const Event& event, std::size_t pair, RuleHold& hold) {
  const Vec3& in_W = rule.places_W[2 * pair];
  const Vec3 way = rule.places_W[2 * pair + 1] - in_W;
  const double length = way.norm();
  if (!(length > 0)) return false;
  const Vec3 past = event.p_W - in_W;
  const double along = past.dot(way) / length;
  const double aside = (past - (along / length) * way).norm();
  const bool near = aside * kMmPerM <= number_of(rule, "near_mm");
  const bool was_before = hold.told && hold.least < 0;
  hold.least = along;
  hold.told = true;  // there is a place before this one
  if (near && was_before && along >= 0) hold.armed = true;
  if (!near || along < 0) hold.armed = false;
  if (!hold.armed || along < length) return false;
  hold.armed = false;
  return true;
}

}  // namespace

std::optional<RuleHit> reached_in_order(const PlannedRule& rule, const Event& event, std::size_t,
                                        double tick_s, RuleState& state) {
  const auto next = std::find(state.done.begin(), state.done.end(), 0);
  if (next == state.done.end()) return std::nullopt;
  const auto mark = static_cast<std::size_t>(next - state.done.begin());
  RuleHold& hold = state.holds[mark];
  const double off_mm = (event.p_W - rule.places_W[mark]).norm() * kMmPerM;
  if (!(off_mm <= number_of(rule, "near_mm"))) {
    hold.since_s = -1;
    return std::nullopt;
  }
  const double now_s = time_of(event, tick_s);
  if (hold.since_s < 0) hold.since_s = now_s;
  if (now_s - hold.since_s >= number_of(rule, "for_s")) state.done[mark] = 1;
  return std::nullopt;
}

std::optional<RuleHit> passed_in_order(const PlannedRule& rule, const Event& event, std::size_t,
                                       double, RuleState& state) {
  const std::size_t pair = first_open_pair(state);
  if (2 * pair + 1 >= state.done.size()) return std::nullopt;
  if (comes_through(rule, event, pair, state.holds[pair]))
    state.done[2 * pair] = state.done[2 * pair + 1] = 1;
  return std::nullopt;
}

std::optional<RuleHit> passed_out_of_order(const PlannedRule& rule, const Event& event, std::size_t,
                                           double tick_s, RuleState& state) {
  std::optional<RuleHit> hit;
  for (std::size_t pair = 0; 2 * pair + 1 < state.done.size(); ++pair) {
    if (!comes_through(rule, event, pair, state.holds[pair])) continue;
    if (pair > first_open_pair(state)) hit = RuleHit{time_of(event, tick_s)};
    if (pair == first_open_pair(state)) state.done[2 * pair] = state.done[2 * pair + 1] = 1;
  }
  return hit;
}

// `armed` of the first mark: the way has begun; `told` of the last: it has ended.
std::optional<RuleHit> strayed(const PlannedRule& rule, const Event& event, std::size_t,
                               double tick_s, RuleState& state) {
  const double off_mm = number_of(rule, "off_mm");
  const auto near = [&](const Vec3& place_W) {
    return (event.p_W - place_W).norm() * kMmPerM <= off_mm;
  };
  RuleHold& first = state.holds.front();
  first.armed = first.armed || near(rule.places_W.front());
  if (state.done.empty() || !first.armed || state.done.back()) return std::nullopt;
  if (near(rule.places_W.back())) state.done.back() = 1;
  const bool wrong = distance_to_polyline(rule.places_W, event.p_W) * kMmPerM > off_mm;
  return lasting(wrong, rule, event, tick_s, first);
}

// The event's values: what share of the part is gone, what share of the rest, and how far beyond.
std::optional<RuleHit> removed(const PlannedRule& rule, const Event& event, std::size_t, double,
                               RuleState& state) {
  if (event.values[0] >= number_of(rule, "share"))
    std::fill(state.done.begin(), state.done.end(), 1);
  return std::nullopt;
}

std::optional<RuleHit> cut_outside(const PlannedRule& rule, const Event& event, std::size_t,
                                   double tick_s, RuleState& state) {
  RuleHold& hold = state.holds[0];
  if (hold.told || !(event.values[2] > number_of(rule, "beyond_mm"))) return std::nullopt;
  hold.told = true;
  return RuleHit{time_of(event, tick_s)};
}

}  // namespace osteon
