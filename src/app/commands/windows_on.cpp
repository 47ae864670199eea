// Compiled where the windows are (OSTEON_WINDOW), else windows_off.cpp.
#include "commands/commands.h"

namespace osteon {

void add_window_commands(cli::App& app, int& exit_code) {
  add_window_command(app, exit_code);
  add_segment_command(app, exit_code);
}

}  // namespace osteon
