#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/case_bone.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/carve/tunnel.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/self_crossing.h"

namespace osteon {
namespace {

struct TunnelCommand {
  std::string bone, from, to, out;
  double diameter_mm = 0, depth_mm = 0;
  bool has_depth = false, json = false;
};

/// A bone with a tunnel, in Bone.
struct Drilled {
  TunnelPlan plan;
  TunnelCut cut;
  double depth_m = 0;  ///< of the drill's end, from `from`
};

Result<double> end_of_drill(const TunnelPlan& plan, const TunnelCommand& command) {
  if (!command.has_depth) return plan.length_m;
  if (!(command.depth_mm > 0))
    return fail("is not above zero", "--depth", "Give a depth in mm, measured from the bone");
  if (plan.passes.empty())
    return fail("is measured from where the axis enters the bone, but the axis misses it",
                "--depth", "Leave it out, or aim the line at the bone");
  return plan.passes.front().entry_m + command.depth_mm / 1000;
}

Result<Drilled> drill(const CaseBone& source, const TunnelCommand& command) {
  const auto from_W = point_from_mm(command.from, "--from");
  if (!from_W) return tl::unexpected(from_W.error());
  const auto to_W = point_from_mm(command.to, "--to");
  if (!to_W) return tl::unexpected(to_W.error());
  const Pose X_BW = source.bone.X_WB.inverse();
  auto plan =
      plan_tunnel(source.bone.mesh, {X_BW * *from_W, X_BW * *to_W, command.diameter_mm / 1000});
  if (!plan) return tl::unexpected(plan.error());
  const auto depth_m = end_of_drill(*plan, command);
  if (!depth_m) return tl::unexpected(depth_m.error());
  auto cut = advance(*plan, *depth_m);
  if (!cut) return tl::unexpected(cut.error());
  return Drilled{std::move(*plan), std::move(*cut), *depth_m};
}

/// The mesh as the file will hold it, which has single precision.
TriMesh rounded(TriMesh mesh, double metres_per_unit) {
  for (Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k)
      v[k] = static_cast<double>(static_cast<float>(v[k] / metres_per_unit)) * metres_per_unit;
  return mesh;
}

/// Pairs of triangles that cross, of which the drill made one at least.
std::size_t new_crossings(const Drilled& d, const TriMesh& mesh) {
  std::vector<bool> made(mesh.triangles.size(), false);
  std::fill(made.end() - static_cast<std::ptrdiff_t>(d.cut.triangles.size()), made.end(), true);
  return self_crossings(mesh, made).size();
}

nlohmann::ordered_json point_json(const Vec3& p) {
  const Vec3 mm = 1000 * p;
  return nlohmann::ordered_json::array({mm.x(), mm.y(), mm.z()});
}

nlohmann::ordered_json passes_json(const Drilled& d, const Pose& X_WB) {
  auto out = nlohmann::ordered_json::array();
  const Vec3 along = (d.plan.line.to - d.plan.line.from).normalized();
  for (const TunnelPass& pass : d.plan.passes) {
    if (pass.entry_m >= d.depth_m) break;
    const double end_m = std::min(pass.exit_m, d.depth_m);
    out.push_back({{"entry_mm", point_json(X_WB * (d.plan.line.from + pass.entry_m * along))},
                   {"exit_mm", point_json(X_WB * (d.plan.line.from + end_m * along))},
                   {"length_mm", 1000 * (end_m - pass.entry_m)}});
  }
  return out;
}

void print_tunnel(const Drilled& d, const CaseBone& source, const TunnelCommand& command) {
  const bool through = d.cut.removed_m3 > 0 && d.cut.bottom_m2 == 0;
  const double removed_mm3 = 1e9 * d.cut.removed_m3;
  const double length_mm = 1000 * drilled_length(d.plan, d.depth_m);
  if (command.json) {
    nlohmann::ordered_json out;
    out["bone"] = source.bone.name;
    out["removed_mm3"] = removed_mm3;
    out["length_mm"] = length_mm;
    out["through"] = through;
    out["passes"] = passes_json(d, source.bone.X_WB);
    out["rims"] = d.cut.rims.size();
    out["sides"] = d.cut.sides;
    out["unit"] = source.unit;
    out["file"] = command.out;
    std::printf("%s\n", out.dump(2).c_str());
    return;
  }
  if (d.cut.removed_m3 == 0)
    std::printf("%s: the drill misses the bone, so nothing is removed -> %s\n",
                source.bone.name.c_str(), command.out.c_str());
  else
    std::printf("%s: removed %.2f mm3, %.2f mm along the axis in bone, %s -> %s (in %s)\n",
                source.bone.name.c_str(), removed_mm3, length_mm,
                through ? "through" : "ends in bone", command.out.c_str(), source.unit.c_str());
}

int run_tunnel(const TunnelCommand& command) {
  const auto source = load_case_bone(command.bone);
  if (!source) return report_error(source.error());
  const auto drilled = drill(*source, command);
  if (!drilled) return report_error(drilled.error());
  const TriMesh mesh = rounded(drilled_bone(drilled->plan, drilled->cut), source->metres_per_unit);
  if (mesh.triangles.empty())
    return report_error(
        {"removes the whole bone", "the tunnel", "Check --diameter, which is in mm"});
  if (const auto saved = save_stl(mesh, command.out, source->metres_per_unit); !saved)
    return report_error(saved.error());
  print_tunnel(*drilled, *source, command);
  if (const std::size_t crossings = new_crossings(*drilled, mesh); crossings > 0) {
    std::fprintf(stderr, "warning: %zu pairs of triangles cross near the tunnel's rim\n",
                 crossings);
    return kExitNo;
  }
  return drilled->cut.removed_m3 > 0 ? kExitDone : kExitNo;
}

}  // namespace

void add_tunnel_command(cli::App& app, int& exit_code) {
  cli::App* tunnel = app.add_subcommand(
      "tunnel", "Drill a straight tunnel into a bone, exactly; exits 1 when the line misses it");
  auto command = std::make_shared<TunnelCommand>();
  tunnel->add_option("bone", command->bone, "CASE#BONE, such as builtin:knee#femur")->required();
  tunnel->add_option("--from", command->from, "x,y,z in mm, World: start of the drill")->required();
  tunnel->add_option("--to", command->to, "x,y,z in mm, World: end of the drill")->required();
  tunnel->add_option("--diameter", command->diameter_mm, "diameter of the drill, mm")->required();
  cli::Option* depth = tunnel->add_option("--depth", command->depth_mm,
                                          "depth, mm, from where the axis first enters the bone to "
                                          "the drill's flat end; overrides the depth of --to");
  tunnel
      ->add_option("--out", command->out,
                   "STL file to write, in the case's unit and the bone's own frame")
      ->required();
  tunnel->add_flag("--json", command->json, "print JSON");
  tunnel->callback([command, depth, &exit_code] {
    command->has_depth = depth->count() > 0;
    exit_code = run_tunnel(*command);
  });
}

}  // namespace osteon
