#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/shapes/collide_table.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/pose_table.h"
#include "osteon/base/file.h"
#include "osteon/base/percentiles.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

struct CollideOptions {
  std::string a;
  std::string b;
  std::string unit;
  std::string poses;
  std::string out;
};

Result<ConvexBody> load_body(const std::string& file, const std::string& unit) {
  const auto mesh = load_mesh(file, metres_per_unit(unit));
  if (!mesh) return tl::unexpected(mesh.error());
  const HullOutcome outcome = build_hull(mesh->vertices);
  if (!outcome.hull)
    return fail("has no convex hull: " + std::string(describe(outcome.failure)), file,
                "A body needs four points that are not in one plane");
  return make_convex_body(*outcome.hull);
}

Result<CollideTable> collide(const CollideOptions& options) {
  const auto text = read_file(options.poses, 256ull << 20);
  if (!text) return tl::unexpected(text.error());
  const auto poses = parse_pose_table(*text, options.poses);
  if (!poses) return tl::unexpected(poses.error());
  const auto a = load_body(options.a, options.unit);
  if (!a) return tl::unexpected(a.error());
  const auto b = load_body(options.b, options.unit);
  if (!b) return tl::unexpected(b.error());
  auto table = make_collide_table(*a, *b, *poses);
  if (!table) return table;
  if (auto ok = write_file_atomic(options.out, table->csv); !ok) return tl::unexpected(ok.error());
  return table;
}

int run(const CollideOptions& options) {
  const auto table = collide(options);
  if (!table) return report_error(table.error());
  std::printf("%zu poses, %zu hits, query median %.0f ns, p99 %.0f ns -> %s\n", table->poses,
              table->hits, table->times.quantile_ns(0.5), table->times.quantile_ns(0.99),
              options.out.c_str());
  return 0;
}

constexpr const char* kFooter =
    "POSES.csv: x_mm,y_mm,z_mm,qw,qx,qy,qz, one pose of B in the frame of A per line.\n"
    "OUT.csv: hit,depth_mm,nx,ny,nz,px_mm,py_mm,pz_mm,pivots,ns, one line per pose.\n"
    "  hit       1: the convex hulls of A and B share a point (touching counts)\n"
    "  depth_mm  how far B must move along n to separate from A; 0 without a hit\n"
    "  n         unit normal from A to B, in the frame of A\n"
    "  p         centre of the largest ball inside both, or, without a hit, of the smallest\n"
    "            ball that reaches the planes of both; in the frame of A\n"
    "  pivots    simplex pivots of the two linear programs, warm-started from the previous line\n"
    "  ns        solution time of the two linear programs";

}  // namespace

void add_collide_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<CollideOptions>();
  cli::App* command = app.add_subcommand(
      "collide", "Test the convex hulls of two meshes for contact, pose by pose");
  command->footer(kFooter);
  command->add_option("A", options->a, "mesh that stays in place")->required();
  command->add_option("B", options->b, "mesh that is moved")->required();
  command->add_option("--unit", options->unit, "unit of both meshes: m, cm or mm")
      ->required()
      ->check(cli::IsMember({"m", "cm", "mm"}));
  command->add_option("--poses", options->poses, "CSV file of poses of B in A")->required();
  command->add_option("--out", options->out, "CSV file to write")->required();
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace osteon
