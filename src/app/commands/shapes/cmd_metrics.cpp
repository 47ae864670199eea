#include <cstdio>
#include <memory>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/tissue_mesh.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/path_metrics.h"

namespace osteon {
namespace {

struct MetricsCommand {
  std::string path, tissue, unit;
  std::vector<double> axis;
  bool json = false;
};

int run_metrics(const MetricsCommand& command) {
  const auto path = load_path(command.path);
  if (!path) return report_error(path.error());
  PathMetricsOptions options;
  if (!command.axis.empty())
    options.axis_W = Vec3(command.axis[0], command.axis[1], command.axis[2]);
  if (!command.tissue.empty()) {
    auto mesh = load_tissue_mesh(command.tissue, command.unit);
    if (!mesh) return report_error(mesh.error());
    auto distance = std::make_shared<const MeshDistance>(std::move(*mesh));
    options.tissue_W = [distance](const Vec3& p_W) {
      return distance->closest(p_W).signed_distance;
    };
  }
  auto metrics = path_metrics(*path, options);
  if (!metrics) {
    if (metrics.error().where == "path") metrics.error().where = command.path;
    return report_error(metrics.error());
  }
  std::fputs((command.json ? to_json(*metrics) : to_text(*metrics)).c_str(), stdout);
  return kExitDone;
}

}  // namespace

void add_metrics_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<MetricsCommand>();
  cli::App* command = app.add_subcommand(
      "metrics",
      "Measure a path: time, length, smoothness, time and damage in a tissue, actions.\n"
      "The tip is the path's position, the shaft runs from it along the pose's +z; damage is the\n"
      "area that the 300 mm behind the tip sweep inside the tissue");
  command->add_option("path", options->path, "probe path, CSV")->required();
  command->add_option("--tissue", options->tissue,
                      "closed surface in the path's frame: a mesh file, or CASE#PART");
  command
      ->add_option("--unit", options->unit,
                   "unit of the mesh file; default: mm when it is more than 3 units across, else m")
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command
      ->add_option("--axis", options->axis,
                   "x,y,z: direction of depth_mm; default: the shaft's own at each moment")
      ->delimiter(',')
      ->expected(3);
  command->add_flag("--json", options->json, "print JSON; a measure that is not defined is null");
  command->callback([options, &exit_code] { exit_code = run_metrics(*options); });
}

}  // namespace osteon
