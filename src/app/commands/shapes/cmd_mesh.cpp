#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "cases/mesh_source.h"
#include "commands/shapes/tet_report.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "osteon/mesh/tet_io.h"
#include "osteon/mesh/tetrahedra.h"

namespace osteon {
namespace {

struct TetrahedraCommand {
  std::string source, unit, out;
  double cell_mm = 0;
  TetrahedraOptions options;
  bool json = false, force = false;
};

int run_tetrahedra(TetrahedraCommand command) {
  const auto source = load_mesh_source(command.source, command.unit);
  if (!source) return report_error(source.error());
  command.options.cell_m = command.cell_mm / 1000;
  auto made = make_tetrahedra(source->mesh, command.options);
  if (!made) {
    made.error().where = command.source;
    return report_error(made.error());
  }
  const std::size_t inverted = made->report.after.inverted;
  if (inverted > 0 && !command.force)
    return report_error(
        {std::to_string(inverted) + " tetrahedra are inverted, so nothing is written",
         command.source,
         "Repair the surface (osteon import mesh), choose a smaller --cell-mm, or give "
         "--force"});
  if (!command.out.empty())
    if (const auto saved = save_vtk(made->mesh, command.out, source->metres_per_unit); !saved)
      return report_error(saved.error());
  const std::string text =
      command.json ? tet_report_json(*source, *made) : tet_report_text(*source, *made);
  std::fputs(text.c_str(), stdout);
  return made->report.warnings.empty() ? kExitDone : kExitNo;
}

void add_tetrahedra(cli::App& mesh, int& exit_code) {
  cli::App* command = mesh.add_subcommand(
      "tetrahedra",
      "Fill a closed surface with tetrahedra of good shape; exits 1 with a warning when the cell "
      "is too coarse, the volume is off by 1 % or more, or an angle is below 15 degrees");
  auto options = std::make_shared<TetrahedraCommand>();
  command
      ->add_option("SOURCE", options->source,
                   "a mesh file, or CASE#PART for a bone or soft part of a case, in World")
      ->required();
  command->add_option("--unit", options->unit, "unit of a mesh file; the result has the same unit")
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command
      ->add_option("--cell-mm", options->cell_mm,
                   "edge of the lattice's cubes, mm; default: chosen from the thinnest part and "
                   "reduced until the volume fits")
      ->check(refuse_not_positive);
  command
      ->add_option("--goal-deg", options->options.goal_deg,
                   "smallest dihedral angle to reach where possible, degrees")
      ->check(cli::Range(0.0, 90.0))
      ->capture_default_str();
  command->add_option("--most", options->options.most_tets, "limit of the number of tetrahedra")
      ->capture_default_str();
  command->add_option("--out", options->out, "write a VTK file (legacy, ASCII); a bone's in mm");
  command->add_flag("--force", options->force, "write the result even with inverted tetrahedra");
  command->add_flag("--json", options->json, "print the report as JSON");
  command->callback([options, &exit_code] { exit_code = run_tetrahedra(*options); });
}

struct QualityCommand {
  std::string file, unit;
  bool json = false;
};

int run_quality(const QualityCommand& command) {
  const auto mesh = load_vtk(command.file, unit_from_text(command.unit).value_or(0));
  if (!mesh) return report_error(mesh.error());
  const std::string text =
      command.json ? tet_quality_json(command.file, *mesh) : tet_quality_text(command.file, *mesh);
  std::fputs(text.c_str(), stdout);
  return quality(*mesh).inverted == 0 ? kExitDone : kExitNo;
}

void add_quality(cli::App& mesh, int& exit_code) {
  cli::App* command = mesh.add_subcommand("quality",
                                          "Measure dihedral angles and volume of a tetrahedral "
                                          "mesh; exits 1 when any element is inverted");
  auto options = std::make_shared<QualityCommand>();
  command->add_option("FILE", options->file, "a VTK file (legacy, ASCII)")->required();
  command->add_option("--unit", options->unit, "unit of the file")
      ->required()
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options, &exit_code] { exit_code = run_quality(*options); });
}

}  // namespace

void add_mesh_commands(cli::App& app, int& exit_code) {
  cli::App* mesh = app.add_subcommand(
      "mesh", "Fill a surface with tetrahedra; smooth, simplify or edit a surface");
  mesh->require_subcommand(1);
  add_tetrahedra(*mesh, exit_code);
  add_quality(*mesh, exit_code);
  add_mesh_surface_commands(*mesh, exit_code);
}

}  // namespace osteon
