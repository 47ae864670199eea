#include "rules/ring_rules.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kTaken = 0, kOnPeg = 1, kElsewhere = 2;  // values[0] of the event

}  // namespace

// `most` of a mark's hold: how many rings have been left on its peg and not been taken again.
std::optional<RuleHit> ringed(const PlannedRule& rule, const Event& event, std::size_t, double,
                              RuleState& state) {
  const double what = event.values[0];
  for (std::size_t m = 0; m < rule.places_W.size(); ++m) {
    const Vec3 off = event.p_W - rule.places_W[m];
    if (!(std::hypot(off.x(), off.y()) * 1000 <= number_of(rule, "near_mm"))) continue;
    double& rings = state.holds[m].most;
    if (what == kOnPeg) rings += 1;
    if (what == kTaken) rings = std::max(0.0, rings - 1);
    state.done[m] = rings > 0 ? 1 : 0;
  }
  return std::nullopt;
}

std::optional<RuleHit> ring_dropped(const PlannedRule&, const Event& event, std::size_t,
                                    double tick_s, RuleState&) {
  if (event.values[0] != kElsewhere) return std::nullopt;
  return RuleHit{time_of(event, tick_s)};
}

}  // namespace osteon
