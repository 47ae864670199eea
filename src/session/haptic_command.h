#pragma once

#include "osteon/haptic/haptic.h"
#include "osteon/scene/command.h"

namespace osteon {

/// Changes `params` as the command says. One for the physics, one of no kind, or one whose value is
/// not finite or out of range changes nothing.
void apply_command(const Command& command, HapticParams& params);

}  // namespace osteon
