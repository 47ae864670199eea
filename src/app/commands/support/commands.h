#pragma once

// One function a command: adds its subcommand to the parser and runs when chosen. The exit code
// goes to `exit_code`. Listed in cli.cpp.

namespace osteon::cli {
class App;
}

namespace osteon {

void add_case_commands(cli::App& app, int& exit_code);        // import mesh, case info, case check
void add_case_pose(cli::App& group, int& exit_code);          // called by the above
void add_case_save(cli::App& group, int& exit_code);          // called by add_case_commands
void add_case_felt_command(cli::App& app, int& exit_code);    // case felt; after add_case_commands
void add_import_ct_command(cli::App& app, int& exit_code);    // import ct; after add_case_commands
void add_scan_command(cli::App& app, int& exit_code);         // scan: a virtual CT of a case
void add_anatomy_commands(cli::App& app, int& exit_code);     // anatomy list, anatomy make
void add_anatomy_compare(cli::App& anatomy, int& exit_code);  // called by the above
void add_mesh_commands(cli::App& app, int& exit_code);        // mesh tetrahedra, mesh quality
void add_mesh_surface_commands(cli::App& mesh, int& exit_code);  // called by the above
void add_hull_command(cli::App& app, int& exit_code);            // hull
void add_tissue_commands(cli::App& app, int& exit_code);         // tissue solve, skin
void add_collide_command(cli::App& app, int& exit_code);         // collide
void add_simulate_command(cli::App& app, int& exit_code);        // simulate
void add_path_commands(cli::App& app, int& exit_code);           // path survey
void add_replay_command(cli::App& app, int& exit_code);          // replay
void add_record_command(cli::App& app, int& exit_code);          // record info, record export
void add_demo_command(cli::App& app, int& exit_code);         // demo: the bundled path, no window
void add_render_command(cli::App& app, int& exit_code);       // render: a picture of a case
void add_live_command(cli::App& app, int& exit_code);         // live: devices, no window
void add_devices_command(cli::App& app, int& exit_code);      // devices
void add_doctor_command(cli::App& app, int& exit_code);       // doctor
void add_stability_command(cli::App& app, int& exit_code);    // stability
void add_instruments_command(cli::App& app, int& exit_code);  // instruments: list, show, render
void add_window_commands(cli::App& app, int& exit_code);    // those below, or none (OSTEON_WINDOW)
void add_window_command(cli::App& app, int& exit_code);     // window
void add_segment_command(cli::App& app, int& exit_code);    // segment: a CT by hand
void add_xray_command(cli::App& app, int& exit_code);       // xray: a picture of a C-arm
void add_view_command(cli::App& app, int& exit_code);       // view: what an arthroscope shows
void add_carve_command(cli::App& app, int& exit_code);      // carve: remove bone along a path
void add_metrics_command(cli::App& app, int& exit_code);    // metrics: of a path
void add_scenario_commands(cli::App& app, int& exit_code);  // scenario list, info, check
void add_run_command(cli::App& app, int& exit_code);        // run: a virtual surgeon
void add_tunnel_command(cli::App& app, int& exit_code);     // tunnel: drilled into a bone
void add_drill_commands(cli::App& app, int& exit_code);     // drill trial, drill resistance
// case measure; after add_case_commands
void add_case_measure_command(cli::App& app, int& exit_code);
void add_results_commands(cli::App& app, int& exit_code);  // results: list, show, curve, ...
void add_debrief_command(cli::App& app, int& exit_code);   // debrief: pages of a recorded attempt
void add_film_commands(cli::App& app, int& exit_code);     // film, sound: of a recording
void add_skill_command(cli::App& app, int& exit_code);     // skill: do scores tell it apart

}  // namespace osteon
