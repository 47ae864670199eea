// Compiled where the windows are left out (OSTEON_WINDOW), else windows_on.cpp.
#include "commands/commands.h"

namespace osteon {

void add_window_commands(cli::App&, int&) {}

}  // namespace osteon
