// Compiled where the windows are (OSTEON_WINDOW), else windows_off.cpp.
#include <cstdlib>
#include <string>

#include "commands/pictures/window_exercise.h"
#include "commands/pictures/windows_in_turn.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"

namespace osteon {

void add_window_commands(cli::App& app, int& exit_code) {
  add_window_command(app, exit_code);
  add_segment_command(app, exit_code);
}

Result<void> exercise_in_window(const std::string& scenario, std::optional<std::uint64_t> seed,
                                const std::string& learner) {
  ::setenv("OSTEON_LEARNER", learner.c_str(), 1);
  WindowOrder order;
  order.exercise = scenario + (seed ? ":" + std::to_string(*seed) : "");
  const int exit_code = run_windows(order);
  if (exit_code != kExitDone)
    return fail("the window ended with exit code " + std::to_string(exit_code), scenario);
  return {};
}

}  // namespace osteon
