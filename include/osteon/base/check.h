#pragma once

#include <cassert>

namespace osteon {

/// Stops the program with a message when `condition` is false, in every build: for states from
/// which going on would corrupt what is saved. For our own bugs in hot code use plain `assert`.
void demand(bool condition, const char* message);

}  // namespace osteon
