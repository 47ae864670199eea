#include "cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "commands/commands.h"

namespace osteon {
namespace {

// True when the first word is neither an option nor a command: the parser itself would only say
// that a command is missing.
bool names_no_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  return std::none_of(commands.begin(), commands.end(),
                      [&](const CLI::App* c) { return c->get_name() == argv[1]; });
}

}  // namespace

int run_cli(int argc, char** argv) {
  CLI::App app("Osteon, an open surgical simulator for orthopaedics", "osteon");
  app.set_version_flag("--version", OSTEON_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  for (const auto add :
       {add_case_commands,     add_case_felt_command,   add_import_ct_command, add_scan_command,
        add_anatomy_commands,  add_mesh_commands,       add_hull_command,      add_collide_command,
        add_path_commands,     add_simulate_command,    add_replay_command,    add_demo_command,
        add_render_command,    add_live_command,        add_devices_command,   add_doctor_command,
        add_stability_command, add_tissue_commands,     add_window_command,    add_segment_command,
        add_xray_command,      add_instruments_command, add_carve_command,     add_view_command,
        add_metrics_command,   add_scenario_commands,   add_run_command})
    add_xray_command, add_instruments_command, add_carve_command, add_tunnel_command,
        add_drill_commands, add_case_measure_command
})
    add(app, exit_code);
try {
  app.parse(argc, argv);
} catch (const CLI::ParseError& e) {
  if (names_no_command(app, argc, argv)) {
    std::fprintf(stderr, "osteon: there is no command '%s'. See osteon --help.\n", argv[1]);
    return 2;
  }
  return app.exit(e) == 0 ? 0 : 2;
} catch (const std::exception& e) {
  std::fprintf(stderr, "osteon: %s\n", e.what());
  return 2;
}
return exit_code;
}

}  // namespace osteon
