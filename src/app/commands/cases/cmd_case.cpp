#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include "commands/support/parser.h"

#include "cases/felt_choice.h"
#include "cases/import_mesh.h"
#include "cases/noted_case.h"
#include "cases/open_case.h"
#include "commands/cases/cmd_case_note.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/progress_line.h"
#include "commands/support/text_table.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/self_crossing.h"
#include "osteon/scene/case_io.h"
#include "osteon/scene/felt_as.h"
#include "osteon/scene/portal.h"

namespace osteon {
namespace {

void print(const std::string& text) { std::fputs(text.c_str(), stdout); }

std::string fma_text(int fma_id) { return fma_id == 0 ? "-" : std::to_string(fma_id); }
std::string yes_no(bool yes) { return yes ? "yes" : "no"; }

// An open surface encloses none.
std::optional<double> volume_cm3(const TriMesh& mesh) {
  if (!topology(mesh).closed()) return std::nullopt;
  return 1e6 * volume(mesh);
}

std::string volume_text(const TriMesh& mesh) {
  const auto cm3 = volume_cm3(mesh);
  return cm3 ? fixed(*cm3, 3) : "-";
}

nlohmann::ordered_json volume_json(const TriMesh& mesh) {
  const auto cm3 = volume_cm3(mesh);
  return cm3 ? nlohmann::ordered_json(*cm3) : nlohmann::ordered_json();
}

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
  std::string text = bone.repair.summary();
  if (bone.hollows > 0) text += ", closed " + plural(bone.hollows, "hollow");
  const std::string more = bone.crossings < kListedCrossings ? "" : "at least ";
  if (bone.crossings > 0)
    text += ", left " + more + plural(bone.crossings, "crossing") + " of triangles";
  return text;
}

int run_import(const ImportOptions& options) {
  const auto result = [&options] {
    ProgressLine line;
    ImportOptions shown = options;
    shown.progress = [say = line.stopping()](double share) { say("Reading the meshes", share); };
    return import_meshes(shown);
  }();
  if (!result) return report_error(result.error());
  TextTable table({"bone", "FMA", "file", "triangles", "closed", "repairs"});
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
               yes_no(topology(soft.mesh_W).closed()), volume_text(soft.mesh_W),
               soft.thickness_m > 0 ? fixed(soft.thickness_m * 1e3, 2) : "-",
               size_text_mm(soft.mesh_W), attachments_text(c, soft)});
  print("\n" + table.text());
}

void print_portals(const Case& c) {
  const std::vector<Portal> portals = find_portals(c);
  if (portals.empty()) return;
  TextTable table({"portal", "name", "at mm"});
  for (const Portal& portal : portals) {
    const Vec3 at_mm = portal.p_W * 1000;
    table.add({portal.title, portal.name,
               fixed(at_mm.x(), 1) + " " + fixed(at_mm.y(), 1) + " " + fixed(at_mm.z(), 1)});
  }
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

// Bones as they are seen: what is felt of them is not cut for it.
Result<Case> build_uncut(CaseDef def) {
  for (BoneDef& bone : def.bones) bone.felt = bone.felt == Felt::kPieces ? Felt::kHull : bone.felt;
  return build_case(std::move(def));
}

void print_head(const Case& c) {
  print(c.name + (c.side.empty() ? "" : " (" + c.side + ")") + ", " +
        plural(c.bones.size(), "bone") + ", " + plural(c.softs.size(), "soft part") + ", " +
        plural(c.landmarks.size(), "landmark") + "\n\n");
  print_findings(c);
  print_joints(c);
}

std::vector<std::string> bone_row(const Bone& bone) {
  return {bone.name,
          fma_text(bone.fma_id),
          std::to_string(bone.mesh.triangles.size()),
          yes_no(topology(bone.mesh).closed()),
          volume_text(bone.mesh),
          fixed(bone.mass_kg * 1e3, 2),
          size_text_mm(bone.mesh)};
}

Vec3 place_of(const CaseNote& note, const Case& c) {
  const BoneId bone = c.find(note.bone);
  return bone.valid() ? c.bone(bone).X_WB * note.p_F : note.p_F;
}

std::string place_text(const CaseNote& note, const Case& c) {
  const Vec3 at_mm = 1000 * place_of(note, c);
  std::string text = note.bone.empty() ? "at " : note.bone + ", at ";
  return text + fixed(at_mm.x(), 1) + " " + fixed(at_mm.y(), 1) + " " + fixed(at_mm.z(), 1) + " mm";
}

void print_notes(const CaseNotes& notes, const Case& c) {
  if (notes.empty()) return;
  print("\n");
  for (std::size_t i = 0; i < notes.size(); ++i)
    print("note " + std::to_string(i + 1) + " (" + place_text(notes[i], c) + "): " + notes[i].text +
          "\n");
}

nlohmann::ordered_json in_mm_json(const Vec3& p) {
  return {1000 * p.x(), 1000 * p.y(), 1000 * p.z()};
}

nlohmann::ordered_json bones_json(const Case& c, const std::vector<Felt>& felt) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < c.bones.size(); ++i)
    list.push_back({{"name", c.bones[i].name},
                    {"fma_id", c.bones[i].fma_id},
                    {"triangles", c.bones[i].mesh.triangles.size()},
                    {"volume_cm3", volume_json(c.bones[i].mesh)},
                    {"mass_g", 1e3 * c.bones[i].mass_kg},
                    {"felt", std::string(to_text(felt[i]))}});
  return list;
}

void print_info_json(const Case& c, const std::vector<Felt>& felt, const CaseNotes& notes) {
  nlohmann::ordered_json out;
  out["case"] = c.name;
  out["side"] = c.side;
  out["bones"] = bones_json(c, felt);
  out["soft_parts"] = nlohmann::ordered_json::array();
  for (const SoftPart& soft : c.softs)
    out["soft_parts"].push_back(
        {{"name", soft.name}, {"kind", soft.kind}, {"tissue", soft.tissue}});
  out["findings"] = nlohmann::ordered_json::array();
  for (const CaseFinding& finding : c.findings)
    out["findings"].push_back(
        {{"name", finding.name}, {"grade", finding.grade}, {"meaning", finding.meaning}});
  out["portals"] = nlohmann::ordered_json::array();
  for (const Portal& portal : find_portals(c))
    out["portals"].push_back({{"name", portal.name}, {"at_mm", in_mm_json(portal.p_W)}});
  out["notes"] = nlohmann::ordered_json::array();
  for (const CaseNote& note : notes)
    out["notes"].push_back(
        {{"text", note.text}, {"bone", note.bone}, {"at_mm", in_mm_json(place_of(note, c))}});
  // Names of files may be any bytes; JSON is UTF-8.
  std::puts(out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

int info_without_pieces(const std::string& spec, bool json) {
  auto def = open_case_def(spec);
  if (!def) return report_error(def.error());
  const auto notes = notes_of(spec);
  if (!notes) return report_error(notes.error());
  if (auto known = check_notes(*notes, *def); !known) return report_error(known.error());
  std::vector<Felt> felt;
  for (const BoneDef& bone : def->bones) felt.push_back(felt_as(bone.mesh, bone.felt));
  for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  const auto built = build_case(std::move(*def));
  if (!built) return report_error(built.error());
  if (json) {
    print_info_json(*built, felt, *notes);
    return kExitDone;
  }
  print_head(*built);
  TextTable table(
      {"bone", "FMA", "triangles", "closed", "volume cm3", "mass g", "size mm", "felt as"});
  for (std::size_t i = 0; i < felt.size(); ++i) {
    std::vector<std::string> row = bone_row(built->bones[i]);
    row.emplace_back(to_text(felt[i]));
    table.add(row);
  }
  print(table.text());
  print_softs(*built);
  print_portals(*built);
  print_notes(*notes, *built);
  return kExitDone;
}

int info_with_pieces(const std::string& spec) {
  const auto notes = notes_of(spec);
  if (!notes) return report_error(notes.error());
  const auto the_case = open_and_show_progress(spec, CaseParts::kAll);
  if (!the_case) return report_error(the_case.error());
  const Case& c = **the_case;
  print_head(c);
  TextTable table({"bone", "FMA", "triangles", "closed", "volume cm3", "mass g", "size mm",
                   "felt as", "hull vertices", "field MB"});
  double field_mb = 0;
  for (const Bone& bone : c.bones) {
    std::size_t corners = 0;
    for (const Hull& piece : bone.pieces) corners += piece.vertices.size();
    std::vector<std::string> row = bone_row(bone);
    row.insert(row.end(), {felt_text(bone), std::to_string(corners), field_text(bone)});
    table.add(row);
    field_mb += bone.field ? 1e-6 * static_cast<double>(bone.field->bytes()) : 0;
  }
  print(table.text());
  print_softs(c);
  print_portals(c);
  print_notes(*notes, c);
  if (field_mb > 0) std::printf("\nthe distance fields take %.1f MB", field_mb);
  std::printf("\nhash %016llx\n", static_cast<unsigned long long>(c.hash));
  return kExitDone;
}

void print_check_json(const std::string& spec, std::size_t bones, std::size_t softs,
                      const std::vector<std::string>& findings) {
  nlohmann::ordered_json out;
  out["case"] = spec;
  out["bones"] = bones;
  out["soft_parts"] = softs;
  out["sound"] = findings.empty();
  out["findings"] = findings;
  // Names of files may be any bytes; JSON is UTF-8.
  std::puts(out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

int run_check(const std::string& spec, bool json) {
  auto def = open_case_def(spec);
  if (!def) return report_error(def.error());
  std::vector<std::string> findings = check_case(*def);
  const auto notes = notes_of(spec);
  if (!notes) findings.push_back(notes.error().message());
  if (notes)
    if (auto known = check_notes(*notes, *def); !known) findings.push_back(known.error().message());
  const std::size_t bones = def->bones.size(), softs = def->softs.size();
  if (const auto built = build_uncut(std::move(*def)); !built)
    findings.push_back(built.error().message());
  if (json) {
    print_check_json(spec, bones, softs, findings);
  } else {
    for (const std::string& finding : findings) print(finding + "\n");
    print(findings.empty() ? plural(bones, "bone") + ", " + plural(softs, "soft part") + ", sound\n"
                           : plural(findings.size(), "finding") + "\n");
  }
  return findings.empty() ? kExitDone : kExitNo;
}

void add_import(cli::App& app, int& exit_code) {
  cli::App* import = app.add_subcommand("import", "Make a case from other data");
  import->require_subcommand(1);
  cli::App* mesh = import->add_subcommand(
      "mesh",
      "Make a case from meshes in one common frame; they are repaired and named after their files");
  auto options = std::make_shared<ImportOptions>();
  mesh->add_option("source", options->source,
                   "a folder of STL, OBJ, PLY, VTK, VTP, glTF files, or one file")
      ->required();
  auto unit = std::make_shared<std::string>();
  mesh->add_option("--unit", *unit, "unit of the files")
      ->required()
      ->check(cli::IsMember({"m", "cm", "mm"}));
  mesh->add_option("--out", options->out, "the case folder to make")->required();
  mesh->add_option("--name", options->name, "name of the case; default: the folder's name");
  mesh->add_option("--side", options->side, "left or right")
      ->check(cli::IsMember({"left", "right"}));
  mesh->add_flag("--keep-hollows", options->keep_hollows,
                 "keep the hollow inside a thin shell whose holes are too small for a ball of 2 "
                 "mm; default: it is filled");
  mesh->add_flag("--force", options->force,
                 "accept bones that are more than three times larger or smaller than usual, and "
                 "parts that overlap or touch");
  mesh->callback([options, unit, &exit_code] {
    options->metres_per_unit = metres_per_unit(*unit);
    exit_code = run_import(*options);
  });
}

void add_case(cli::App& app, int& exit_code) {
  cli::App* group = app.add_subcommand("case", "Inspect, check, measure and change a case");
  group->require_subcommand(1);
  auto spec = std::make_shared<std::string>();
  cli::App* info = group->add_subcommand("info", "List the bones of a case");
  info->add_option("case", *spec, "a case folder, builtin:wrist or builtin:knee")->required();
  auto pieces = std::make_shared<bool>(false);
  cli::Option* const info_pieces = info->add_flag(
      "--pieces", *pieces,
      "cut the bones into the convex pieces that the probe feels, and list them too");
  auto info_json = std::make_shared<bool>(false);
  info->add_flag("--json", *info_json,
                 "print JSON: case, side, bones, soft_parts, findings, portals, notes")
      ->excludes(info_pieces);
  info->callback([spec, pieces, info_json, &exit_code] {
    exit_code = *pieces ? info_with_pieces(*spec) : info_without_pieces(*spec, *info_json);
  });
  cli::App* check = group->add_subcommand("check",
                                          "Check a case for problems; exits 0 when it is sound, 1 "
                                          "with findings, 2 when it cannot be read");
  check->add_option("case", *spec, "a case folder, builtin:wrist or builtin:knee")->required();
  auto json = std::make_shared<bool>(false);
  check->add_flag("--json", *json, "print JSON: case, bones, soft_parts, sound, findings");
  check->callback([spec, json, &exit_code] { exit_code = run_check(*spec, *json); });
  add_case_pose(*group, exit_code);
  add_case_save(*group, exit_code);
  add_case_note(*group, exit_code);
}

}  // namespace

void add_case_commands(cli::App& app, int& exit_code) {
  add_import(app, exit_code);
  add_case(app, exit_code);
}

}  // namespace osteon
