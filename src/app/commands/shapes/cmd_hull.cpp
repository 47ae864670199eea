#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

struct HullOptions {
  std::vector<std::string> meshes;
  std::string unit = "m";
  std::string out;
  bool json = false;
};

struct MeshHull {
  std::string mesh;
  Hull hull;
  HullStats stats;
};

Result<MeshHull> hull_of(const std::string& file, double unit_m) {
  const Result<TriMesh> mesh = load_mesh(file, unit_m);
  if (!mesh) return tl::unexpected(mesh.error());
  HullStats stats;
  HullOutcome outcome = build_hull(mesh->vertices, &stats);
  if (!outcome.hull) {
    return fail("the mesh has no convex hull: " + std::string(describe(outcome.failure)), file,
                "Give a mesh with at least four vertices that are not in one plane");
  }
  return MeshHull{file, std::move(*outcome.hull), stats};
}

/// The hull in the mesh's own unit, from the vertices as they stand in the file.
Result<void> write_hull(const MeshHull& result, const HullOptions& options) {
  return save_stl(to_mesh(result.hull), options.out, metres_per_unit(options.unit));
}

nlohmann::json to_json(const MeshHull& r) {
  return {{"mesh", r.mesh},
          {"input_points", r.stats.input_points},
          {"duplicates", r.stats.duplicates},
          {"discarded_by_quickhull", r.stats.discarded_by_quickhull},
          {"given_to_wrapping", r.stats.given_to_wrapping},
          {"discarded_by_wrapping", r.stats.discarded_by_wrapping},
          {"exact_tests", r.stats.exact_tests},
          {"vertices", r.hull.vertices.size()},
          {"facets", r.hull.planes.size()},
          {"triangles", r.hull.triangles.size()},
          {"volume_m3", r.hull.volume},
          {"time_s", r.stats.seconds}};
}

void print(const MeshHull& r) {
  std::printf("%s\n", r.mesh.c_str());
  std::printf("  hull        %zu vertices, %zu facets, volume %.6g cm^3\n", r.hull.vertices.size(),
              r.hull.planes.size(), r.hull.volume * 1e6);
  std::printf("  input       %zu points, %zu copies\n", r.stats.input_points, r.stats.duplicates);
  std::printf("  quickhull   discarded %zu points inside the growing polyhedron\n",
              r.stats.discarded_by_quickhull);
  std::printf("  wrapping    %zu points given, %zu discarded\n", r.stats.given_to_wrapping,
              r.stats.discarded_by_wrapping);
  std::printf("  time        %.3f ms, %zu exact tests\n", r.stats.seconds * 1e3,
              r.stats.exact_tests);
}

int run(const HullOptions& options) {
  if (!options.out.empty() && options.meshes.size() != 1) {
    return report_error({"--out takes the hull of one mesh, and " +
                             std::to_string(options.meshes.size()) + " were given",
                         options.out, "call the command once for each mesh"});
  }
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& file : options.meshes) {
    const Result<MeshHull> result = hull_of(file, metres_per_unit(options.unit));
    if (!result) return report_error(result.error());
    if (!options.out.empty()) {
      const Result<void> written = write_hull(*result, options);
      if (!written) return report_error(written.error());
    }
    if (options.json) {
      all.push_back(to_json(*result));
    } else {
      print(*result);
    }
  }
  // Names of files may be any bytes; JSON is UTF-8.
  if (options.json) {
    std::puts(all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  }
  return 0;
}

}  // namespace

void add_hull_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<HullOptions>();
  cli::App* command =
      app.add_subcommand("hull", "Convex hulls of meshes, by QuickHull and wrapping");
  command->add_option("MESH", options->meshes, "STL, OBJ, PLY, VTK, VTP or glTF files")->required();
  command->add_option("--unit", options->unit, "unit of the meshes: m, cm or mm")
      ->capture_default_str()
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command->add_option("--out", options->out,
                      "write the hull as STL, in the mesh's unit (one mesh)");
  command->add_flag("--json", options->json, "print JSON: an array with one object per mesh");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace osteon
