#include "cli.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "commands/cases/cmd_case_laxity.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "commands/support/parser.h"
#include "commands/support/progress_line.h"
#include "commands/support/wrong_word.h"
#include "commands/teaching/cmd_launch.h"

namespace osteon {
namespace {

// --quiet anywhere: what a command prints goes nowhere, errors stay.
void add_quiet(CLI::App& app) {
  app.add_flag_callback(
      "--quiet",
      [] {
        ProgressLine::keep_silent();
        if (!std::freopen("/dev/null", "w", stdout)) throw std::runtime_error("no /dev/null");
      },
      "Print errors only; the exit code gives the result. Works after any command");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    command->fallthrough();
    for (CLI::App* sub : command->get_subcommands([](const CLI::App*) { return true; }))
      sub->fallthrough();
  }
}

}  // namespace

int run_cli(int argc, char** argv) {
  cli::App commands("Osteon, an open surgical simulator for orthopaedics", "osteon");
  CLI::App& app = commands.parser();
  app.set_version_flag("--version", OSTEON_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  for (const auto add : {add_case_commands,        add_case_felt_command, add_import_ct_command,
                         add_scan_command,         add_anatomy_commands,  add_mesh_commands,
                         add_hull_command,         add_collide_command,   add_path_commands,
                         add_simulate_command,     add_replay_command,    add_record_command,
                         add_demo_command,         add_render_command,    add_live_command,
                         add_devices_command,      add_doctor_command,    add_stability_command,
                         add_tissue_commands,      add_window_commands,   add_xray_command,
                         add_instruments_command,  add_carve_command,     add_view_command,
                         add_metrics_command,      add_scenario_commands, add_run_command,
                         add_tunnel_command,       add_drill_commands,    add_case_measure_command,
                         add_case_laxity_commands, add_results_commands,  add_debrief_command,
                         add_skill_command,        add_film_commands,     add_launch_command})
    add(commands, exit_code);
  check_all_numbers(app);
  add_quiet(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    if (const auto wrong = wrong_word(app, {argv + 1, argv + argc})) {
      std::fprintf(stderr, "osteon: %s\n", wrong->c_str());
      return kExitBad;
    }
    app.exit(e);
    return kExitBad;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "osteon: %s\n", e.what());
    return kExitBad;
  }
  return exit_code;
}

}  // namespace osteon
