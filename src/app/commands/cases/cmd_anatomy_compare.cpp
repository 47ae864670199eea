#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>
#include "commands/support/parser.h"

#include "cases/import_mesh.h"
#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/text_table.h"
#include "osteon/anatomy/bone_gaps.h"
#include "osteon/anatomy/likeness.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

/// Surfaces nearer than this are listed as a joint.
constexpr double kJointReach_m = 0.003;

/// Long bones are compared at their end at the joint alone: the built-in ones may be sawn through.
constexpr std::pair<const char*, double> kEnds_m[] = {
    {"radius", 0.045}, {"ulna", 0.045}, {"femur", 0.1}, {"tibia", 0.09}};

struct CompareCommand {
  std::string case_spec, reference;
  double metres_per_unit = 1;
  bool json = false;
};

struct BoneLikeness {
  std::string name;
  Likeness likeness;
  double end_m = 0;
};

Result<CaseDef> open_reference(const CompareCommand& command) {
  std::error_code ec;
  const std::filesystem::path folder(command.reference);
  if (command.reference.starts_with("builtin:") ||
      std::filesystem::exists(folder / "case.toml", ec))
    return open_case_def(command.reference);
  ImportOptions options;
  options.source = folder;
  options.out = folder;
  options.metres_per_unit = command.metres_per_unit;
  auto read = read_meshes(options);
  if (!read) return tl::unexpected(read.error());
  return std::move(read->def);
}

Vec3 middle_of(const TriMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : mesh.vertices) sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(1, mesh.vertices.size()));
}

/// The joint end of a long bone is the one that the other bones lie at.
LikenessOptions options_for(const CaseDef& def, std::size_t index) {
  LikenessOptions options;
  const BoneDef& bone = def.bones[index];
  for (const auto& [name, end_m] : kEnds_m)
    if (bone.name == name) options.end_m = end_m;
  Vec3 others_W = Vec3::Zero();
  for (std::size_t i = 0; i < def.bones.size(); ++i)
    if (i != index) others_W += def.bones[i].X_WB * middle_of(def.bones[i].mesh);
  if (def.bones.size() < 2) options.end_m = 0;
  others_W /= static_cast<double>(std::max<std::size_t>(2, def.bones.size()) - 1);
  options.towards_end_B = bone.X_WB.inverse() * others_W - middle_of(bone.mesh);
  return options;
}

std::vector<BoneLikeness> compare(const CaseDef& def, const CaseDef& reference) {
  std::vector<BoneLikeness> rows;
  for (std::size_t i = 0; i < def.bones.size(); ++i)
    for (const BoneDef& other : reference.bones) {
      if (other.name != def.bones[i].name) continue;
      const LikenessOptions options = options_for(def, i);
      rows.push_back(
          {other.name, compare_surfaces(def.bones[i].mesh, other.mesh, options), options.end_m});
    }
  return rows;
}

std::vector<BoneGap> gaps_of(const CaseDef& def) {
  std::vector<TriMesh> meshes_W;
  for (const BoneDef& bone : def.bones) {
    meshes_W.push_back(bone.mesh);
    for (Vec3& v : meshes_W.back().vertices) v = bone.X_WB * v;
  }
  return bone_gaps(meshes_W, kJointReach_m);
}

double rounded_mm(double metres) { return std::round(metres * 1e6) / 1e3; }

void print_json(const CaseDef& def, const std::vector<BoneLikeness>& rows,
                const std::vector<BoneGap>& gaps) {
  Json json = {{"bones", Json::array()}, {"gaps", Json::array()}};
  for (const BoneLikeness& row : rows)
    json["bones"].push_back({{"bone", row.name},
                             {"mean_mm", rounded_mm(row.likeness.mean_m)},
                             {"p95_mm", rounded_mm(row.likeness.p95_m)},
                             {"scale", row.likeness.scale},
                             {"end_mm", rounded_mm(row.end_m)}});
  for (const BoneGap& gap : gaps)
    json["gaps"].push_back({{"bone", def.bones[gap.first].name},
                            {"other", def.bones[gap.second].name},
                            {"gap_mm", rounded_mm(gap.gap_m)}});
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_tables(const CaseDef& def, const std::vector<BoneLikeness>& rows,
                  const std::vector<BoneGap>& gaps) {
  TextTable likeness({"bone", "mean mm", "95 % mm", "scale", "compared"});
  for (const BoneLikeness& row : rows)
    likeness.add({row.name, fixed(row.likeness.mean_m * 1e3, 2), fixed(row.likeness.p95_m * 1e3, 2),
                  fixed(row.likeness.scale, 3),
                  row.end_m > 0 ? "end of " + fixed(row.end_m * 1e3, 0) + " mm" : "all"});
  std::fputs(likeness.text().c_str(), stdout);
  if (gaps.empty()) {
    std::puts("\nNo two bones are closer than 3 mm.");
    return;
  }
  std::puts("\nBones closer than 3 mm; a negative gap is an overlap");
  TextTable table({"bone", "other", "gap mm"});
  for (const BoneGap& gap : gaps)
    table.add({def.bones[gap.first].name, def.bones[gap.second].name, fixed(gap.gap_m * 1e3, 2)});
  std::fputs(table.text().c_str(), stdout);
}

int run_compare(const CompareCommand& command) {
  const auto def = open_case_def(command.case_spec);
  if (!def) return report_error(def.error());
  const auto reference = open_reference(command);
  if (!reference) return report_error(reference.error());
  const std::vector<BoneLikeness> rows = compare(*def, *reference);
  if (rows.empty())
    return report_error({"has no bone of the same name as the case's", command.reference,
                         "Name its files after the bones: osteon case info " + command.case_spec});
  const std::vector<BoneGap> gaps = gaps_of(*def);
  if (command.json)
    print_json(*def, rows, gaps);
  else
    print_tables(*def, rows, gaps);
  return kExitDone;
}

}  // namespace

void add_anatomy_compare(cli::App& anatomy, int& exit_code) {
  cli::App* sub = anatomy.add_subcommand("compare",
                                         "Align bones of the same name and measure the distance "
                                         "between their surfaces; list joint gaps and overlaps");
  auto command = std::make_shared<CompareCommand>();
  sub->add_option("case", command->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->required();
  sub->add_option("--reference", command->reference, "a case, or a folder of meshes")->required();
  auto unit = std::make_shared<std::string>("m");
  sub->add_option("--unit", *unit, "unit of a reference folder's meshes; default: m")
      ->check(cli::IsMember({"m", "cm", "mm"}));
  sub->add_flag("--json", command->json, "print JSON");
  sub->callback([command, unit, &exit_code] {
    command->metres_per_unit = metres_per_unit(*unit);
    exit_code = run_compare(*command);
  });
}

}  // namespace osteon
