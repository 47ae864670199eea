#include "rules/stump_rules.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/sound_part_watch.h"
#include "osteon/procedure/stump_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

bool is_enough(const PlannedRule& rule, double percent) {
  return percent >= std::floor(100 * number_of(rule, "share") + 1e-9);
}

bool is_too_much(const PlannedRule& rule, double percent) {
  return percent > 100 * number_of(rule, "share");
}

// One of a part that is felt, when it has lost too much.
std::optional<RuleHit> lost_hit(const PlannedRule& rule, const Event& event, double tick_s) {
  const double most = number_of(rule, event.values[0] > 0 ? "lost_mm3" : "lost_percent");
  const double now = std::floor(std::max(event.values[0], event.values[1]));
  if (!(now >= most && event.values[2] < most)) return std::nullopt;
  return RuleHit{time_of(event, tick_s)};
}

// One visit of a tip is one error, of a part that is not felt.
std::optional<RuleHit> cut_hit(const PlannedRule& rule, const Event& event, double tick_s,
                               RuleHold& hold) {
  if (event.kind == kSoundPartLost) return lost_hit(rule, event, tick_s);
  if (event.kind != kSoundPartCleared) return std::nullopt;
  const double for_s = event.values[0];
  if (for_s < hold.last_s) hold.told = false;
  hold.last_s = for_s;
  const bool wrong =
      for_s >= number_of(rule, "for_s") && event.values[1] >= number_of(rule, "deep_mm");
  if (!wrong || hold.told) return std::nullopt;
  hold.told = true;
  return RuleHit{time_of(event, tick_s)};
}

}  // namespace

const std::vector<RuleKind>& stump_rule_table() {
  static const std::vector<RuleKind> table{
      {"stumps_cleared",
       "this share of what torn ligaments have left is cleared, footprints apart",
       true,
       {{"share", 0.01, 1, 0.9}},
       SubjectKind::kNothing,
       kStumpsCleared},
      {"stump_left",
       "a tunnel is begun before this share of what torn ligaments have left is cleared",
       false,
       {{"share", 0.01, 1, 0.9}},
       SubjectKind::kNothing,
       kStumpsCleared,
       false,
       kTunnelBegun},
      {"stumps_unseen",
       "more than this share of what torn ligaments have left is cleared while no scope in another "
       "portal sees the tip, or the water hides everything",
       false,
       {{"share", 0.01, 1, 0.1}},
       SubjectKind::kNothing,
       kStumpsCleared},
      {"sound_part_cut",
       "a ligament or meniscus that is felt has lost so much of its strands or of its volume to "
       "instruments; in one that is not felt, what clears soft tissue runs for so long, and so "
       "deep",
       false,
       {{"for_s", 0, 10, 0.3},
        {"deep_mm", 0, 20, 1},
        {"lost_mm3", 1, 10000, 10},
        {"lost_percent", 1, 100, 5}},
       SubjectKind::kNothing,
       kSoundPartCleared,
       false,
       kSoundPartLost},
  };
  return table;
}

// `most` of the hold is the percentage that is gone.
bool step_stump_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                     std::optional<RuleHit>& hit) {
  const auto& table = stump_rule_table();
  const auto kind = std::find_if(table.begin(), table.end(),
                                 [&](const RuleKind& k) { return k.name == rule.rule.kind; });
  if (kind == table.end()) return false;
  hit.reset();
  RuleHold& hold = state.holds[0];
  if (kind->name == "sound_part_cut") {
    hit = cut_hit(rule, event, tick_s, hold);
    return true;
  }
  if (event.kind == kStumpsCleared) hold.most = event.values[0];
  if (kind->is_goal) {
    state.met = is_enough(rule, hold.most);
    return true;
  }
  const bool wrong = kind->name == "stumps_unseen"
                         ? event.kind == kStumpsCleared && is_too_much(rule, event.values[1])
                         : event.kind == kTunnelBegun && !is_enough(rule, hold.most);
  if (wrong && !hold.told) {
    hold.told = true;
    hit = RuleHit{time_of(event, tick_s)};
  }
  return true;
}

}  // namespace osteon
