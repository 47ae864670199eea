#pragma once

#include <optional>

#include "osteon/procedure/judge.h"

namespace osteon {

/// What one event makes of a rule: how far its state is, and whether an error has been made.
/// Null: the event says nothing to it. `at_s` of a made error is when it began.
struct RuleHit {
  double at_s = 0;
};

/// What the functions behind rules share.
double number_of(const PlannedRule& rule, const char* name);
double time_of(const Event& event, double tick_s);
/// An error once a wrong thing has lasted for the rule's `for_s`; another one only after it has
/// been right again.
std::optional<RuleHit> lasting(bool wrong, const PlannedRule& rule, const Event& event,
                               double tick_s, RuleHold& hold);

/// The function behind a kind of rule: pure, of (rule, event), with the state that it carries on.
std::optional<RuleHit> step_rule(const PlannedRule& rule, const Event& event, double tick_s,
                                 RuleState& state);

}  // namespace osteon
