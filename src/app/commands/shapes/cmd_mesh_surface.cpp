#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/mesh_source.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "commands/support/text_table.h"
#include "osteon/mesh/decimate.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_edit.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/self_crossing.h"
#include "osteon/mesh/taubin.h"

namespace osteon {
namespace {

struct SurfaceCommand {
  std::string source, unit, out;
};

/// Largest distance of either surface's vertices from the other surface, m.
double largest_move(const TriMesh& before, const TriMesh& after) {
  const MeshDistance to_before(before), to_after(after);
  double most = 0;
  for (const Vec3& v : after.vertices)
    most = std::max(most, std::abs(to_before.closest(v).signed_distance));
  for (const Vec3& v : before.vertices)
    most = std::max(most, std::abs(to_after.closest(v).signed_distance));
  return most;
}

/// Writes the surface and says what became of it. What is wrong with it is a finding: exit code 1.
int finish(const MeshSource& source, const TriMesh& after, const std::string& out,
           EditFindings findings) {
  if (const auto saved = save_stl(after, out, source.metres_per_unit); !saved)
    return report_error(saved.error());
  std::printf("%s: %zu -> %zu triangles, volume %.4f -> %.4f cm3, moved %.3f mm at most -> %s\n",
              source.name.c_str(), source.mesh.triangles.size(), after.triangles.size(),
              1e6 * volume(source.mesh), 1e6 * volume(after),
              1000 * largest_move(source.mesh, after), out.c_str());
  findings.crossings = self_crossings(after);
  if (findings.sound()) return kExitDone;
  std::printf("warning: %s\n", findings.summary().c_str());
  return kExitNo;
}

void add_source(cli::App& command, SurfaceCommand& options) {
  command
      .add_option("SOURCE", options.source,
                  "a mesh file, or CASE#PART for a bone or soft part, in World")
      ->required();
  command.add_option("--unit", options.unit, "unit of a mesh file; the result has the same unit")
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command.add_option("--out", options.out, "the STL file to write; a bone's in mm")->required();
}

struct SmoothCommand : SurfaceCommand {
  TaubinOptions options;
};

int run_smooth(const SmoothCommand& command) {
  const auto source = load_mesh_source(command.source, command.unit);
  if (!source) return report_error(source.error());
  TriMesh mesh = source->mesh;
  smooth_taubin(mesh, command.options);
  return finish(*source, mesh, command.out, {});
}

void add_smooth(cli::App& mesh, int& exit_code) {
  auto command = std::make_shared<SmoothCommand>();
  cli::App* smooth =
      mesh.add_subcommand("smooth", "Smooth a surface without shrinking it (Taubin, lambda | mu)");
  add_source(*smooth, *command);
  smooth->add_option("--rounds", command->options.rounds, "number of smoothing passes")
      ->capture_default_str()
      ->check(cli::Range(1, 1000));
  smooth->callback([command, &exit_code] { exit_code = run_smooth(*command); });
}

struct DecimateCommand : SurfaceCommand {
  double error_mm = 0.05;
};

int run_decimate(const DecimateCommand& command) {
  const auto source = load_mesh_source(command.source, command.unit);
  if (!source) return report_error(source.error());
  TriMesh mesh = source->mesh;
  decimate(mesh, command.error_mm / 1000);
  return finish(*source, mesh, command.out, {});
}

void add_decimate(cli::App& mesh, int& exit_code) {
  auto command = std::make_shared<DecimateCommand>();
  cli::App* decimate =
      mesh.add_subcommand("decimate", "Reduce the triangles of a surface (quadric error)");
  add_source(*decimate, *command);
  decimate
      ->add_option("--error-mm", command->error_mm,
                   "how far the surface may move, mm, approximately")
      ->capture_default_str()
      ->check(refuse_not_positive);
  decimate->callback([command, &exit_code] { exit_code = run_decimate(*command); });
}

struct DragCommand : SurfaceCommand {
  std::vector<double> at_mm, by_mm;
  double radius_mm = 5;
  std::string fall_off = "smooth";
};

Vec3 metres(const std::vector<double>& mm) { return Vec3(mm[0], mm[1], mm[2]) / 1000; }

int run_drag(const DragCommand& command) {
  const auto source = load_mesh_source(command.source, command.unit);
  if (!source) return report_error(source.error());
  auto edit = MeshEdit::begin(source->mesh);
  if (!edit) return report_error(edit.error());
  const std::uint32_t vertex = edit->nearest_vertex(metres(command.at_mm));
  const SoftSelection selection{command.radius_mm / 1000,
                                fall_off_from_text(command.fall_off).value_or(FallOff::kSmooth)};
  if (const auto grabbed = edit->grab(vertex, selection); !grabbed)
    return report_error(grabbed.error());
  const Vec3 at_mm = 1000 * edit->grabbed_at();
  std::printf("grabbed vertex %u at (%.3f, %.3f, %.3f) mm, %zu vertices follow\n", vertex,
              at_mm.x(), at_mm.y(), at_mm.z(), edit->selected().size());
  edit->drag(metres(command.by_mm));
  const EditFindings findings = edit->commit();
  return finish(*source, edit->mesh(), command.out, EditFindings{findings.turned, {}});
}

void add_drag(cli::App& mesh, int& exit_code) {
  auto command = std::make_shared<DragCommand>();
  cli::App* drag = mesh.add_subcommand(
      "drag", "Drag one vertex of a surface; its neighbours along the surface follow");
  add_source(*drag, *command);
  drag->add_option("--at-mm", command->at_mm, "x y z: the nearest vertex is grabbed")
      ->required()
      ->expected(3);
  drag->add_option("--by-mm", command->by_mm, "x y z: how far it is dragged")
      ->required()
      ->expected(3);
  drag->add_option("--radius-mm", command->radius_mm,
                   "how far along the surface the neighbours follow, mm")
      ->capture_default_str()
      ->check(refuse_not_positive);
  drag->add_option("--fall-off", command->fall_off, "smooth, cone, dome or spike")
      ->capture_default_str()
      ->check(cli::IsMember({"smooth", "cone", "dome", "spike"}));
  drag->callback([command, &exit_code] { exit_code = run_drag(*command); });
}

}  // namespace

void add_mesh_surface_commands(cli::App& mesh, int& exit_code) {
  add_smooth(mesh, exit_code);
  add_decimate(mesh, exit_code);
  add_drag(mesh, exit_code);
}

}  // namespace osteon
