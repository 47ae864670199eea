#pragma once

#include "commands/support/headless.h"
#include "exercises/attempt_watch.h"
#include "osteon/surgeon/hand_player.h"

namespace osteon {

/// A hand of a run without a window whose will is a virtual surgeon's: an emulated hand with a mass
/// and a grip. `player` and `params` must outlive it.
HeadlessHand played_by(HandPlayer& player, const PlannedHand& hand, const HandParams& params);

}  // namespace osteon
