// Compiled where the windows are left out (OSTEON_WINDOW), else windows_on.cpp.
#include "commands/commands.h"

namespace osteon {

void add_window_commands(CLI::App&, int&) {}

}  // namespace osteon
