// Reading of case.toml.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>

#include "case/case_toml_joints.h"
#include "case/case_toml_reader.h"
#include "numbers.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr std::size_t kLongestName = 64;

bool is_plain_name(const std::string& name) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  return !name.empty() && name.size() <= kLongestName &&
         std::none_of(name.begin(), name.end(), is_control);
}

std::string read_name(CaseTomlReader& reader) {
  std::string name = reader.text("name");
  if (!is_plain_name(name))
    reader.set_error("'name' must have 1 to " + std::to_string(kLongestName) +
                         " bytes and no control characters",
                     "name");
  return name;
}

// A file in the case's folder or below it, by its spelling; links are looked at when it is read.
bool stays_inside(const std::string& file) {
  if (file.empty() || file.find_first_of("\\:") != std::string::npos ||
      file.find('\0') != std::string::npos)
    return false;
  const fs::path path(file);
  return path.is_relative() && std::none_of(path.begin(), path.end(), [](const fs::path& part) {
           return part == ".." || part == "." || part.empty();
         });
}

std::string read_mesh_file(CaseTomlReader& reader) {
  std::string file = reader.text("mesh");
  if (!stays_inside(file))
    reader.set_error("'mesh' must name a file in the case's folder", "mesh",
                     "Copy the mesh into the folder and use its plain name");
  return file;
}

double read_unit(CaseTomlReader& reader) {
  const std::string unit = reader.text_or("mesh_unit", "m");
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  reader.set_error("'mesh_unit' must be m, cm or mm", "mesh_unit");
  return 1;
}

std::string read_side(CaseTomlReader& reader) {
  std::string side = reader.text_or("side", "");
  if (side != "left" && side != "right" && !side.empty())
    reader.set_error("'side' must be left, right or empty", "side");
  return side;
}

Pose read_pose(CaseTomlReader& reader) {
  Pose X_WB;
  if (reader.has("position_m")) X_WB.p = reader.position("position_m");
  if (reader.has("rotation_wxyz")) {
    const std::vector<double> q = reader.numbers("rotation_wxyz", 4, {-1.001, 1.001});
    const auto unit = as_unit(Quat(q[0], q[1], q[2], q[3]));
    if (unit)
      X_WB.q = *unit;
    else
      reader.set_error("'rotation_wxyz' must be a quaternion of length 1", "rotation_wxyz");
  }
  return X_WB;
}

Felt read_felt(CaseTomlReader& reader) {
  const auto felt = felt_from_text(reader.text_or("felt", "pieces"));
  if (!felt) reader.set_error("'felt' must be pieces, hull, field or covered", "felt");
  return felt.value_or(Felt::kPieces);
}

Material read_material(CaseTomlReader& bone, const std::string& where, const std::string& title) {
  Material m;
  const toml::table* table = bone.table_or_null("material");
  if (!table) return m;
  CaseTomlReader reader(*table, where, title);
  reader.allow_only({"stiffness_n_per_m", "static_friction", "dynamic_friction"});
  m.stiffness_n_per_m = reader.number_or("stiffness_n_per_m", {1, 1e6}, m.stiffness_n_per_m);
  m.static_friction = reader.number_or("static_friction", {0, 10}, m.static_friction);
  m.dynamic_friction = reader.number_or("dynamic_friction", {0, 10}, m.dynamic_friction);
  if (m.dynamic_friction > m.static_friction)
    reader.set_error("'dynamic_friction' must not exceed 'static_friction'", "dynamic_friction");
  bone.adopt_error(reader);
  return m;
}

void read_bone(const toml::table& table, const std::string& where, CaseText& out,
               CaseTomlReader& file) {
  const std::string title = "bone " + std::to_string(out.def.bones.size() + 1);
  CaseTomlReader reader(table, where, title);
  reader.allow_only({"name", "fma_id", "mesh", "position_m", "rotation_wxyz", "felt", "beside",
                     "density_kg_per_m3", "material"});
  BoneDef bone;
  bone.name = read_name(reader);
  bone.fma_id = reader.integer_or("fma_id", {0, 10'000'000}, fma_id_of(bone.name));
  out.mesh_files.push_back(read_mesh_file(reader));
  bone.X_WB = read_pose(reader);
  bone.felt = read_felt(reader);
  bone.beside = reader.flag_or("beside", false);
  bone.density_kg_per_m3 =
      reader.number_or("density_kg_per_m3", {1, 25'000}, bone.density_kg_per_m3);
  bone.material = read_material(reader, where, title);
  out.def.bones.push_back(std::move(bone));
  file.adopt_error(reader);
}

std::string read_soft_kind(CaseTomlReader& reader) {
  std::string kind = reader.text("kind");
  const auto kinds = soft_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    reader.set_error("'kind' must be cartilage, ligament, tendon, disc, meniscus, fat or skin",
                     "kind");
  return kind;
}

/// The name of a bone that the case has.
std::string read_bone_name(CaseTomlReader& reader, std::string_view key, std::string name,
                           const CaseText& out) {
  const auto& bones = out.def.bones;
  if (std::none_of(bones.begin(), bones.end(), [&](const BoneDef& b) { return b.name == name; }))
    reader.set_error("there is no bone '" + name + "'", key);
  return name;
}

void read_attachment(const toml::table& table, const std::string& where, const CaseText& out,
                     const std::string& title, SoftDef& soft, CaseTomlReader& parent) {
  CaseTomlReader reader(table, where,
                        title + ", attachment " + std::to_string(soft.attachments.size() + 1));
  reader.allow_only({"name", "bone", "position_m"});
  AttachmentDef attachment;
  attachment.name = read_name(reader);
  attachment.bone = read_bone_name(reader, "bone", reader.text("bone"), out);
  attachment.p_W = reader.position("position_m");
  soft.attachments.push_back(std::move(attachment));
  parent.adopt_error(reader);
}

void read_soft(const toml::table& table, const std::string& where, CaseText& out,
               CaseTomlReader& file) {
  const std::string title = "soft part " + std::to_string(out.def.softs.size() + 1);
  CaseTomlReader reader(table, where, title);
  reader.allow_only(
      {"name", "fma_id", "tissue", "kind", "mesh", "thickness_m", "bones", "attachments"});
  SoftDef soft;
  soft.name = read_name(reader);
  soft.fma_id = reader.integer_or("fma_id", {0, 10'000'000}, 0);
  soft.tissue = reader.text("tissue");
  soft.kind = read_soft_kind(reader);
  out.soft_files.push_back(read_mesh_file(reader));
  soft.thickness_m = reader.number_or("thickness_m", {0, 1}, 0);
  for (std::string& name : reader.texts_or_empty("bones"))
    soft.bones.push_back(read_bone_name(reader, "bones", std::move(name), out));
  for (const toml::table* attachment : reader.tables_or_empty("attachments"))
    read_attachment(*attachment, where, out, title, soft, reader);
  out.def.softs.push_back(std::move(soft));
  file.adopt_error(reader);
}

void read_landmark(const toml::table& table, const std::string& where, CaseText& out,
                   CaseTomlReader& file) {
  CaseTomlReader reader(table, where, "landmark " + std::to_string(out.def.landmarks.size() + 1));
  reader.allow_only({"name", "position_m", "inwards", "bone"});
  Landmark landmark;
  landmark.name = read_name(reader);
  landmark.p_W = reader.position("position_m");
  if (reader.has("inwards")) {
    landmark.inwards_W = reader.position("inwards");
    constexpr double kUnit = 1e-6;
    if (!(std::abs(landmark.inwards_W.norm() - 1) < kUnit))
      reader.set_error("'inwards' must be of length 1", "inwards");
  }
  if (reader.has("bone")) landmark.bone = reader.text("bone");
  out.def.landmarks.push_back(std::move(landmark));
  file.adopt_error(reader);
}

void read_finding(const toml::table& table, const std::string& where, CaseText& out,
                  CaseTomlReader& file) {
  CaseTomlReader reader(table, where, "finding " + std::to_string(out.def.findings.size() + 1));
  reader.allow_only({"name", "grade", "meaning"});
  CaseFinding finding;
  finding.name = read_name(reader);
  finding.grade = reader.text_or("grade", "");
  finding.meaning = reader.text_or("meaning", "");
  out.def.findings.push_back(std::move(finding));
  file.adopt_error(reader);
}

Result<CaseText> read_case(const toml::table& root, const std::string& where) {
  CaseTomlReader reader(root, where, "");
  CaseText out;
  reader.number("format", {kFormat, kFormat});
  reader.allow_only({"format", "name", "side", "mesh_unit", "bones", "soft", "landmarks",
                     "findings", "joints", "recipe"});
  out.def.name = read_name(reader);
  out.def.side = read_side(reader);
  out.metres_per_unit = read_unit(reader);
  for (const toml::table* bone : reader.tables_or_empty("bones"))
    read_bone(*bone, where, out, reader);
  for (const toml::table* soft : reader.tables_or_empty("soft"))
    read_soft(*soft, where, out, reader);
  for (const toml::table* landmark : reader.tables_or_empty("landmarks"))
    read_landmark(*landmark, where, out, reader);
  for (const toml::table* finding : reader.tables_or_empty("findings"))
    read_finding(*finding, where, out, reader);
  read_joints(reader, where, out);
  read_recipe(reader, where, out);
  if (out.def.bones.empty() || out.def.bones.size() > kMaxBones)
    reader.set_error("a case has 1 to " + std::to_string(kMaxBones) + " bones", "bones");
  if (out.def.softs.size() > kMaxSofts)
    reader.set_error("a case has at most " + std::to_string(kMaxSofts) + " soft parts", "soft");
  if (reader.error()) return tl::unexpected(*reader.error());
  return out;
}

}  // namespace

Result<CaseText> parse_case_toml(std::string_view text, const std::string& where) {
  try {
    return read_case(toml::parse(text), where);
  } catch (const toml::parse_error& e) {
    return fail("is not TOML: " + std::string(e.description()), case_toml_place(where, e.source()),
                "Fix the line");
  } catch (const std::exception& e) {
    return fail(std::string("cannot be read (") + e.what() + ")", where);
  }
}

}  // namespace osteon
