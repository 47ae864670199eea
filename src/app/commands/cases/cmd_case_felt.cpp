#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/text_table.h"
#include "osteon/scene/felt_distance.h"

namespace osteon {
namespace {

std::string in_mm(double metres) { return fixed(1000 * metres, 3); }

nlohmann::ordered_json json_of(const SurfaceGap& gap) {
  return {{"mean", 1000 * gap.mean}, {"p95", 1000 * gap.p95}, {"max", 1000 * gap.max}};
}

nlohmann::ordered_json json_of(const Bone& bone, const FeltDistance& d) {
  nlohmann::ordered_json out;
  out["felt"] = std::string(to_text(bone.felt));
  out["pieces"] = bone.pieces.size();
  if (bone.field) {
    out["field_bytes"] = bone.field->bytes();
    out["field_cell_mm"] = 1000 * bone.field->cell_m();
  }
  out["mesh_to_felt_mm"] = json_of(d.mesh_to_felt);
  out["felt_to_mesh_mm"] = json_of(d.felt_to_mesh);
  out["mesh_to_felt_at_ends_mm"] = json_of(d.mesh_to_felt_at_ends);
  out["felt_to_mesh_at_ends_mm"] = json_of(d.felt_to_mesh_at_ends);
  return out;
}

void print_json(const Case& c) {
  nlohmann::ordered_json out;
  out["case"] = c.name;
  for (const Bone& bone : c.bones) out["bones"][bone.name] = json_of(bone, felt_distance(bone));
  std::printf("%s\n", out.dump(2).c_str());
}

void print_table(const Case& c) {
  TextTable table({"bone", "felt as", "pieces", "mesh to felt mm", "p95", "max", "felt to mesh mm",
                   "p95", "max", "max at ends", "field MB"});
  for (const Bone& bone : c.bones) {
    const FeltDistance d = felt_distance(bone);
    const double megabytes = bone.field ? 1e-6 * static_cast<double>(bone.field->bytes()) : 0;
    table.add({bone.name, std::string(to_text(bone.felt)), std::to_string(bone.pieces.size()),
               in_mm(d.mesh_to_felt.mean), in_mm(d.mesh_to_felt.p95), in_mm(d.mesh_to_felt.max),
               in_mm(d.felt_to_mesh.mean), in_mm(d.felt_to_mesh.p95), in_mm(d.felt_to_mesh.max),
               in_mm(d.felt_to_mesh_at_ends.max), bone.field ? fixed(megabytes, 1) : "-"});
  }
  std::fputs(table.text().c_str(), stdout);
}

}  // namespace

void add_case_felt_command(cli::App& app, int& exit_code) {
  cli::App* felt = app.get_subcommand("case")->add_subcommand(
      "felt", "Distance between each bone's mesh and the shape that the probe feels");
  auto spec = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  felt->add_option("case", *spec,
                   "a case folder, builtin:wrist or builtin:knee; CASE#BONE=pieces, hull, "
                   "field or covered chooses how a bone is felt")
      ->required();
  felt->add_flag("--json", *json, "print JSON, lengths in millimetres");
  felt->callback([spec, json, &exit_code] {
    const auto the_case = open_and_show_progress(*spec, CaseParts::kFelt);
    if (!the_case) {
      exit_code = report_error(the_case.error());
      return;
    }
    *json ? print_json(**the_case) : print_table(**the_case);
    exit_code = kExitDone;
  });
}

}  // namespace osteon
