#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Friction of a tool on soft parts, from tick to tick: how far the tool has gone over what it
/// presses since it was last held there.
struct SoftRub {
  Vec3 lag_W = Vec3::Zero();
  bool sliding = false;
};

/// What rubs in a tick.
struct RubNow {
  Vec3 push_W = Vec3::Zero();  ///< of all parts on the tool, without friction, N
  double resting_n = 0;        ///< the most that friction holds: ratio times force of each, in all
  double sliding_n = 0;        ///< the same while it slides
  Vec3 way_W = Vec3::Zero();   ///< of the tool over the parts in this tick, m
  double stiffness_n_per_m = 0, damping_n_s_per_m = 0;  ///< of the coupling
  double tick_s = 0.001;
};

/// Coulomb's law on a spring (Harwin and Melder, Eurohaptics 2002, of the coupling): friction
/// holds by stiffness times lag until that is more than `resting_n`; then the lag falls, by a
/// twentieth in a tick, to what `sliding_n` stretches, so that slipping is no step of the force. It
/// holds again when the tool goes back by more than that. Returns the force on the hand, across
/// `push_W` and never more than `resting_n`; zero where nothing is pushed.
Vec3 rub(const RubNow& now, SoftRub& state);

}  // namespace osteon
