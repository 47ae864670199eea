#include "rules/graft_rules.h"

#include <array>
#include <cmath>
#include <string>

#include "osteon/procedure/graft_watch.h"

namespace osteon {
namespace {

constexpr std::size_t kGraftFixedKinds = 13;
constexpr double kGraftMost = 1000;
constexpr double kLeastSizer_mm = 1e3 * kLeastSizer_m, kStep_mm = 1e3 * kSizerStep_m;

// Names of the rules about measures live as long as the program.
const std::array<std::string, kGraftValueNames.size()>& graft_outside_names() {
  static const auto names = [] {
    std::array<std::string, kGraftValueNames.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = "outside_" + std::string(kGraftValueNames[i]);
    return all;
  }();
  return names;
}

std::vector<RuleKind> make_graft_table() {
  constexpr SubjectKind kOfNothing = SubjectKind::kNothing;
  std::vector<RuleKind> table{
      {"tendons_stripped",
       "the given number of tendons has been stripped, whole or not",
       true,
       {{"least", 1, 2, 2}},
       kOfNothing},
      {"muscle_off",
       "at most that share of its muscle is left on either tendon",
       true,
       {{"most_left_pct", 0, 100, 10}},
       kOfNothing},
      {"tendons_stitched",
       "thread goes through the end of each tendon at least that often",
       true,
       {{"least", 1, kMostStitches, 5}},
       kOfNothing},
      {"graft_folded",
       "the graft has the given number of strands",
       true,
       {{"least", 1, 8, 4}},
       kOfNothing},
      {"graft_sized",
       "a sizer went over the graft and the next smaller one did not; it is thick and long enough",
       true,
       {{"least_mm", 4, 12, 8}, {"least_length_mm", 10, 200, 75}},
       kOfNothing},
      {"graft_tensioned",
       "the board has kept the graft stretched for the given time, as if by 80 N",
       true,
       {{"least_s", 0, 36000, 60}},
       kOfNothing},
      {"loop_hung", "a button's loop hangs on the graft", true, {}, kOfNothing},
      {"fascia_opened",
       "the fascia over the tendons is open over the given length in one piece",
       true,
       {{"least_mm", 1, kGraftMost, 30}},
       kOfNothing},
      {"tendons_found",
       "the given number of tendons has been lifted out from under the fascia",
       true,
       {{"least", 1, 2, 2}},
       kOfNothing},
      {"mcl_cut",
       "a blade that opens the fascia is pressed so hard that it cuts the ligament under it",
       false,
       {},
       kOfNothing},
      {"nerve_cut",
       "a blade is drawn over the nerve that runs behind the gracilis",
       false,
       {},
       kOfNothing},
      {"tendon_amputated", "a stripper cut a tendon off at a band", false, {}, kOfNothing},
      {"button_stuck",
       "with this loop the graft meets the socket's end before the button can turn",
       false,
       {},
       kOfNothing},
  };
  for (const std::string& name : graft_outside_names())
    table.push_back({name,
                     "the named value of the graft is outside the range from least to most",
                     false,
                     {{"least", -kGraftMost, kGraftMost, -kGraftMost},
                      {"most", -kGraftMost, kGraftMost, kGraftMost}},
                     kOfNothing});
  return table;
}

bool is_sized(const PlannedRule& rule, const Event& event) {
  const double passed = event.values[0], refused = event.values[1];
  const bool least = passed < kLeastSizer_mm + 0.01;
  const bool next = std::abs(passed - refused - kStep_mm) < 0.01;
  return passed > 0 && (least || next) && passed > number_of(rule, "least_mm") - 0.01 &&
         event.values[2] >= number_of(rule, "least_length_mm");
}

bool goal_holds(const std::string& kind, const PlannedRule& rule, const Event& event) {
  if (kind == "muscle_off")
    return event.kind == kMuscleScraped && event.values[0] <= number_of(rule, "most_left_pct");
  if (kind == "tendons_stitched")
    return event.kind == kTendonStitched && event.values[0] >= number_of(rule, "least");
  if (kind == "graft_folded")
    return event.kind == kTendonFolded && event.values[0] >= number_of(rule, "least");
  if (kind == "graft_sized") return event.kind == kGraftSized && is_sized(rule, event);
  if (kind == "graft_tensioned")
    return event.kind == kGraftTensioned && event.values[0] >= number_of(rule, "least_s");
  if (kind == "fascia_opened")
    return event.kind == kFasciaOpened && event.values[0] >= number_of(rule, "least_mm");
  if (kind == "tendons_found")
    return event.kind == kTendonFound && event.values[0] >= number_of(rule, "least");
  return kind == "loop_hung" && event.kind == kLoopHung;
}

// `most` of the hold counts tendons.
bool all_stripped(const PlannedRule& rule, const Event& event, RuleState& state) {
  if (event.kind == kTendonStripped) state.holds[0].most += 1;
  return state.holds[0].most >= number_of(rule, "least");
}

bool error_made(std::size_t place, const PlannedRule& rule, const Event& event) {
  const std::string& kind = rule.rule.kind;
  if (kind == "tendon_amputated") return event.kind == kTendonStripped && event.values[1] > 0;
  if (kind == "mcl_cut") return event.kind == kByFasciaHurt && event.values[0] == 0;
  if (kind == "nerve_cut") return event.kind == kByFasciaHurt && event.values[0] == 1;
  if (kind == "button_stuck") return event.kind == kLoopHung && event.values[2] == 0;
  if (event.kind != kGraftMeasured ||
      event.values[0] != static_cast<double>(place - kGraftFixedKinds))
    return false;
  return event.values[1] < number_of(rule, "least") || event.values[1] > number_of(rule, "most");
}

}  // namespace

const std::vector<RuleKind>& graft_rule_table() {
  static const std::vector<RuleKind> table = make_graft_table();
  return table;
}

bool step_graft_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                     std::optional<RuleHit>& hit) {
  const auto& table = graft_rule_table();
  std::size_t kind = 0;
  while (kind < table.size() && table[kind].name != rule.rule.kind) ++kind;
  if (kind == table.size()) return false;
  hit.reset();
  if (table[kind].is_goal) {
    const bool holds = rule.rule.kind == "tendons_stripped"
                           ? all_stripped(rule, event, state)
                           : goal_holds(rule.rule.kind, rule, event);
    if (holds) state.holds[0].told = true;
    state.met = state.holds[0].told;
  } else if (error_made(kind, rule, event)) {
    hit = RuleHit{time_of(event, tick_s)};
  }
  return true;
}

}  // namespace osteon
