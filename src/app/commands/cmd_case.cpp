#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "cases/import_mesh.h"
#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/text_table.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

void print(const std::string& text) { std::fputs(text.c_str(), stdout); }

std::string fma_text(int fma_id) { return fma_id == 0 ? "-" : std::to_string(fma_id); }
std::string yes_no(bool yes) { return yes ? "yes" : "no"; }

std::string size_text_mm(const TriMesh& mesh) {
  const Vec3 size_mm = bounds(mesh).extent() * 1000;
  std::string text = fixed(size_mm.x(), 1);
  text.append(" x ").append(fixed(size_mm.y(), 1));
  text.append(" x ").append(fixed(size_mm.z(), 1));
  return text;
}

std::string plural(std::size_t count, const std::string& one) {
  std::string text = std::to_string(count);
  text.append(" ").append(one);
  return count == 1 ? text : text + "s";
}

std::string mended_text(const ImportedBone& bone) {
  const std::string mended = bone.repair.summary();
  return bone.hollows == 0 ? mended : mended + ", walled up " + plural(bone.hollows, "hollow");
}

int run_import(const ImportOptions& options) {
  const auto result = import_meshes(options);
  if (!result) return report_error(result.error());
  TextTable table({"bone", "FMA", "file", "triangles", "closed", "mended"});
  for (std::size_t i = 0; i < result->bones.size(); ++i) {
    const ImportedBone& imported = result->bones[i];
    const BoneDef& bone = result->def.bones[i];
    table.add({bone.name, fma_text(bone.fma_id), imported.file.filename().string(),
               std::to_string(imported.triangles), yes_no(imported.closed), mended_text(imported)});
  }
  print(table.text());
  for (const std::string& finding : check_case(result->def)) print("note: " + finding + "\n");
  print(plural(result->bones.size(), "bone") + " -> " + options.out.string() + "\n");
  return kExitDone;
}

std::string felt_text(const Bone& bone) {
  return bone.felt == Felt::kPieces ? plural(bone.pieces.size(), "piece")
                                    : std::string(to_text(bone.felt));
}

// Memory that the bone's distance field takes.
std::string field_text(const Bone& bone) {
  return bone.field ? fixed(1e-6 * static_cast<double>(bone.field->bytes()), 1) : "-";
}

std::string attachments_text(const Case& c, const SoftPart& soft) {
  std::string text;
  for (const Attachment& attachment : soft.attachments) {
    const std::string& bone = c.bone(attachment.bone).name;
    text += (text.empty() ? "" : ", ") + bone;
    if (attachment.name != bone) text += " (" + attachment.name + ")";
  }
  return text.empty() ? "-" : text;
}

void print_softs(const Case& c) {
  if (c.softs.empty()) return;
  TextTable table({"soft part", "kind", "tissue", "triangles", "closed", "volume cm3",
                   "thickness mm", "size mm", "attachments"});
  for (const SoftPart& soft : c.softs)
    table.add({soft.name, soft.kind, soft.tissue, std::to_string(soft.mesh_W.triangles.size()),
               yes_no(topology(soft.mesh_W).closed()), fixed(volume(soft.mesh_W) * 1e6, 3),
               soft.thickness_m > 0 ? fixed(soft.thickness_m * 1e3, 2) : "-",
               size_text_mm(soft.mesh_W), attachments_text(c, soft)});
  print("\n" + table.text());
}

void print_joints(const Case& c) {
  for (const CaseJoint& joint : c.joints) {
    std::printf("joint %s: bent to %g degrees, of %g to %g; moves", joint.name.c_str(),
                joint.at_deg, joint.min_deg(), joint.max_deg());
    for (const CaseJoint::Moved& moved : joint.bones)
      std::printf(" %s", c.bone(moved.bone).name.c_str());
    std::printf(" against %s\n\n", c.bone(joint.fixed).name.c_str());
  }
}

void print_findings(const Case& c) {
  for (const CaseFinding& finding : c.findings)
    print("finding " + finding.name + (finding.grade.empty() ? "" : "=" + finding.grade) + ": " +
          finding.meaning + "\n");
  if (!c.findings.empty()) print("\n");
}

int run_info(const std::string& spec) {
  const auto the_case = open_case(spec);
  if (!the_case) return report_error(the_case.error());
  const Case& c = **the_case;
  TextTable table({"bone", "FMA", "triangles", "closed", "volume cm3", "mass g", "size mm",
                   "felt as", "hull vertices", "field MB"});
  for (const Bone& bone : c.bones) {
    std::size_t corners = 0;
    for (const Hull& piece : bone.pieces) corners += piece.vertices.size();
    table.add({bone.name, fma_text(bone.fma_id), std::to_string(bone.mesh.triangles.size()),
               yes_no(topology(bone.mesh).closed()), fixed(volume(bone.mesh) * 1e6, 3),
               fixed(bone.mass_kg * 1e3, 2), size_text_mm(bone.mesh), felt_text(bone),
               std::to_string(corners), field_text(bone)});
  }
  print(c.name + (c.side.empty() ? "" : " (" + c.side + ")") + ", " +
        plural(c.bones.size(), "bone") + ", " + plural(c.softs.size(), "soft part") + ", " +
        plural(c.landmarks.size(), "landmark") + "\n\n");
  print_findings(c);
  print_joints(c);
  print(table.text());
  print_softs(c);
  double field_mb = 0;
  for (const Bone& bone : c.bones)
    field_mb += bone.field ? 1e-6 * static_cast<double>(bone.field->bytes()) : 0;
  if (field_mb > 0) std::printf("\nthe distance fields take %.1f MB", field_mb);
  std::printf("\nhash %016llx\n", static_cast<unsigned long long>(c.hash));
  return kExitDone;
}

int run_check(const std::string& spec) {
  auto def = open_case_def(spec);
  if (!def) return report_error(def.error());
  std::vector<std::string> findings = check_case(*def);
  const std::string parts =
      plural(def->bones.size(), "bone") + ", " + plural(def->softs.size(), "soft part");
  if (const auto built = build_case(std::move(*def)); !built)
    findings.push_back(built.error().message());
  for (const std::string& finding : findings) print(finding + "\n");
  print(findings.empty() ? parts + ", sound\n" : plural(findings.size(), "finding") + "\n");
  return findings.empty() ? kExitDone : kExitNo;
}

void add_import(CLI::App& app, int& exit_code) {
  CLI::App* import = app.add_subcommand("import", "Make a case from other data");
  import->require_subcommand(1);
  CLI::App* mesh = import->add_subcommand(
      "mesh", "Make a case from meshes in one common frame: mended, named by their files");
  auto options = std::make_shared<ImportOptions>();
  mesh->add_option("source", options->source, "a folder of STL, OBJ, PLY, glTF files, or one file")
      ->required();
  auto unit = std::make_shared<std::string>();
  mesh->add_option("--unit", *unit, "unit of the files")
      ->required()
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  mesh->add_option("--out", options->out, "the case folder to make")->required();
  mesh->add_option("--name", options->name, "name of the case; default: that of the folder");
  mesh->add_option("--side", options->side, "left or right")
      ->check(CLI::IsMember({"left", "right"}));
  mesh->add_flag("--keep-hollows", options->keep_hollows,
                 "leave the marrow of a thin shell open where no ball of 2 mm gets in");
  mesh->callback([options, unit, &exit_code] {
    options->metres_per_unit = metres_per_unit(*unit);
    exit_code = run_import(*options);
  });
}

void add_case(CLI::App& app, int& exit_code) {
  CLI::App* group = app.add_subcommand("case", "Look at a case");
  group->require_subcommand(1);
  auto spec = std::make_shared<std::string>();
  CLI::App* info = group->add_subcommand("info", "List the bones of a case");
  info->add_option("case", *spec, "a case folder, builtin:wrist or builtin:knee")->required();
  info->callback([spec, &exit_code] { exit_code = run_info(*spec); });
  CLI::App* check = group->add_subcommand(
      "check", "Look for trouble in a case; exits 0 when sound, 1 with findings, 2 unreadable");
  check->add_option("case", *spec, "a case folder, builtin:wrist or builtin:knee")->required();
  check->callback([spec, &exit_code] { exit_code = run_check(*spec); });
  add_case_pose(*group, exit_code);
}

}  // namespace

void add_case_commands(CLI::App& app, int& exit_code) {
  add_import(app, exit_code);
  add_case(app, exit_code);
}

}  // namespace osteon
