// Compiled where the windows are left out (OSTEON_WINDOW), else windows_on.cpp.
#include "commands/pictures/window_exercise.h"
#include "commands/support/commands.h"

namespace osteon {

void add_window_commands(cli::App&, int&) {}

Result<void> exercise_in_window(const std::string& scenario, std::optional<std::uint64_t>,
                                const std::string&) {
  return fail("this program has no windows", scenario, "Let a virtual surgeon do it: --surgeon");
}

}  // namespace osteon
