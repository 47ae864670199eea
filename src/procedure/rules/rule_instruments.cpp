#include "rule_instruments.h"

#include <algorithm>

namespace osteon {
namespace {

std::string_view without_size(std::string_view instrument) {
  return instrument.substr(0, instrument.find(':'));
}

}  // namespace

bool is_of(const Rule& rule, std::string_view instrument) {
  const auto& names = rule.instruments;
  return names.empty() ||
         std::find(names.begin(), names.end(), without_size(instrument)) != names.end();
}

bool is_in_tray(const Scenario& scenario, const Rule& rule, std::string_view instrument) {
  const auto is_it = [&](const std::string& name) { return without_size(name) == instrument; };
  return std::any_of(scenario.hands.begin(), scenario.hands.end(), [&](const ScenarioHand& hand) {
    const bool meant = rule.hand.empty() || rule.hand == hand.name;
    return meant &&
           (is_it(hand.instrument) || std::any_of(hand.also.begin(), hand.also.end(), is_it));
  });
}

}  // namespace osteon
