#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/shapes/skin_picture.h"
#include "commands/shapes/skin_report.h"
#include "commands/shapes/tissue_report.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/tissue/skin_place.h"
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

struct TissueSkinCommand {
  std::string scene, out, picture;
  bool json = false;
};

Result<void> place_skin(const SkinScene& scene, SkinResult& result, SkinDrawing& drawing,
                        std::optional<Pose>& X_WS) {
  constexpr double kReach_m = 0.015;
  const auto opened = open_and_show_progress(scene.place->the_case, CaseParts::kSeen);
  if (!opened) return tl::unexpected(opened.error());
  const Case& the_case = **opened;
  TriMesh skin;
  for (const SoftPart& soft : the_case.softs)
    if (soft.kind == "skin") skin = soft.mesh_W;
  Vec3 near = scene.place->near_W;
  if (const std::string& name = scene.place->landmark; !name.empty()) {
    const auto at = std::find_if(the_case.landmarks.begin(), the_case.landmarks.end(),
                                 [&](const Landmark& l) { return l.name == name; });
    if (at == the_case.landmarks.end())
      return fail("the case has no landmark '" + name + "'", scene.name + ", 'place.at'",
                  "'osteon case info " + scene.place->the_case + "' lists them");
    near = at->p_W;
  }
  const auto frame =
      sheet_frame(skin, near, anatomical_frame(the_case).distal_W, scene.place->turn_rad, kReach_m);
  if (!frame) return tl::unexpected(frame.error());
  X_WS = *frame;
  auto laid = lay_on(skin, *frame, result.surface);
  if (!laid) return tl::unexpected(laid.error());
  result.surface = std::move(*laid);
  drawing.around = around(skin, *frame, scene.width_m, scene.height_m);
  drawing.out_of_skin = frame->rotate(Vec3::UnitZ());
  drawing.up = frame->rotate(Vec3::UnitY());
  return {};
}

int run_tissue_skin(const TissueSkinCommand& command) {
  const auto scene = load_skin_scene(command.scene);
  if (!scene) return report_error(scene.error());
  auto result = run_skin(*scene);
  if (!result) return report_error(result.error());
  SkinDrawing drawing;
  std::optional<Pose> X_WS;
  if (scene->place)
    if (const auto placed = place_skin(*scene, *result, drawing, X_WS); !placed)
      return report_error(placed.error());
  if (!command.out.empty())
    if (const auto saved = write_file_atomic(command.out, skin_vtk(*result)); !saved)
      return report_error(saved.error());
  drawing.surface = result->surface;
  drawing.triangles = result->triangles;
  if (!command.picture.empty())
    if (const auto drawn = draw_skin(drawing, command.picture); !drawn)
      return report_error(drawn.error());
  const std::string text =
      command.json ? skin_report_json(*result, X_WS) : skin_report_text(*result, X_WS);
  std::fputs(text.c_str(), stdout);
  return kExitDone;
}

void add_skin(cli::App& tissue, int& exit_code) {
  cli::App* command = tissue.add_subcommand("skin",
                                            "Cut, press and pierce a piece of skin, and print how "
                                            "far it opens and which forces it takes");
  const auto options = std::make_shared<TissueSkinCommand>();
  command->add_option("SCENE", options->scene, "scene file (TOML, see docs/tissue.md)")->required();
  command->add_option("--out", options->out,
                      "VTK file to write the skin to (legacy, ASCII, mm; part 0 skin, 1 groove)");
  command->add_option("--picture", options->picture, "PNG file to draw the skin to");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->callback([options, &exit_code] { exit_code = run_tissue_skin(*options); });
}

}  // namespace

void add_tissue_commands(cli::App& app, int& exit_code) {
  cli::App* tissue =
      app.add_subcommand("tissue", "Compute how a soft body deforms, or skin is cut");
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
  add_skin(*tissue, exit_code);
}

}  // namespace osteon
