#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/shapes/tissue_report.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "osteon/tissue/solve.h"

namespace osteon {
namespace {

struct TissueSolveCommand {
  std::string scene, out;
  bool json = false;
};

int tell_lost(const SolveLost& lost) {
  std::fprintf(
      stderr,
      "osteon: %s near (%.4g, %.4g, %.4g) mm was turned inside out or squeezed flat before "
      "%.4g s. The figures are of the last state without that. Load the body less or more slowly, "
      "or use smaller cells.\n",
      lost.part.c_str(), 1000 * lost.at_m.x(), 1000 * lost.at_m.y(), 1000 * lost.at_m.z(),
      lost.time_s);
  return kExitNo;
}

int run_tissue_solve(const TissueSolveCommand& command) {
  const auto scene = load_solve_scene(command.scene);
  if (!scene) return report_error(scene.error());
  const std::int64_t start_ns = steady_now_ns();
  const auto result = solve(*scene);
  if (!result) return report_error(result.error());
  const double wall_s = 1e-9 * static_cast<double>(steady_now_ns() - start_ns);
  if (!command.out.empty())
    if (const auto saved = write_file_atomic(command.out, solve_vtk(result->shape)); !saved)
      return report_error(saved.error());
  const std::string text =
      command.json ? solve_report_json(*result, wall_s) : solve_report_text(*result, wall_s);
  std::fputs(text.c_str(), stdout);
  return result->lost ? tell_lost(*result->lost) : kExitDone;
}

}  // namespace

void add_tissue_commands(cli::App& app, int& exit_code) {
  cli::App* tissue = app.add_subcommand("tissue", "Compute how a soft body deforms");
  tissue->require_subcommand(1);
  cli::App* command = tissue->add_subcommand(
      "solve",
      "Load one soft body and print how far it moves and which forces hold it. Exits 1 when a part "
      "of it turns inside out");
  const auto options = std::make_shared<TissueSolveCommand>();
  command->add_option("SCENE", options->scene, "scene file (TOML, see docs/tissue.md)")->required();
  command->add_option("--out", options->out,
                      "VTK file to write the deformed body to (legacy, ASCII, mm)");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->callback([options, &exit_code] { exit_code = run_tissue_solve(*options); });
}

}  // namespace osteon
