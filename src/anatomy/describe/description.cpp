#include "describe/description.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "describe/part_reader.h"
#include "describe/shape_count.h"
#include "describe/toml_reader.h"
#include "joint/joint_reader.h"
#include "soft/soft_reader.h"

namespace osteon {
namespace {

std::string where_of(const std::string& file, const char* kind, const toml::table& table) {
  const auto name = table["name"].value<std::string>();
  return file + ": " + kind + " " +
         (name ? "'" + *name + "'" : "at line " + std::to_string(table.source().begin.line));
}

Result<BoneDescription> read_bone(const toml::table& table, const std::string& file) {
  TomlReader in(table, where_of(file, "bone", table));
  BoneDescription bone;
  bone.name = in.text("name");
  if (in.has("fma_id")) bone.fma_id = in.integer("fma_id", 1, 999999999);
  bone.density_kg_per_m3 = in.number_or("density_kg_per_m3", {1, 30000}, 1900);
  bone.cell_m = in.number_or("cell_mm", kCell_mm, bone.cell_m / kMm) * kMm;
  bone.p_WB = in.vec3("position_mm", kPlace_mm) * kMm;
  bone.R_WB = rotation_xyz_deg(in.vec3_or("rotation_deg", kAngle_deg, Vec3::Zero()));
  const double blend = in.number_or("blend_mm", kBlend_mm, 0) * kMm;
  if (auto ok = read_parts(in, "add", Operation::kAdd, blend, bone.solid); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_parts(in, "cut", Operation::kCut, blend, bone.solid); !ok)
    return tl::unexpected(ok.error());
  in.tables("clear", false);  // read once every bone is known
  if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
  bone.shape_numbers = count_shape_numbers(table);
  return bone;
}

Result<std::size_t> find_bone(const AnatomyDescription& anatomy, const std::string& name) {
  for (std::size_t i = 0; i < anatomy.bones.size(); ++i)
    if (anatomy.bones[i].name == name) return i;
  return fail("names no bone: '" + name + "'");
}

Result<void> read_clearances(const toml::table& table, const std::string& file,
                             const AnatomyDescription& anatomy, std::size_t self,
                             std::vector<Clearance>& clearances) {
  TomlReader bone(table, where_of(file, "bone", table));
  std::size_t n = 0;
  for (const toml::table* entry : bone.tables("clear", false)) {
    TomlReader in(*entry, bone.where() + ", clear " + std::to_string(++n));
    Clearance c;
    const auto other = find_bone(anatomy, in.text("bone"));
    if (!other) in.reject(other.error().what, "bone");
    c.other_bone = other.value_or(0);
    if (other && *other == self) in.reject("must be another bone", "bone");
    c.gap = in.number("gap_mm", {0, 50}) * kMm;
    c.blend = in.number_or("blend_mm", kBlend_mm, 0.5) * kMm;
    if (auto ok = in.finish(); !ok) return ok;
    clearances.push_back(c);
  }
  return {};
}

Result<void> read_bones(TomlReader& root, const std::string& file, AnatomyDescription& anatomy) {
  const auto tables = root.tables("bone", true);
  for (const toml::table* table : tables) {
    auto bone = read_bone(*table, file);
    if (!bone) return tl::unexpected(bone.error());
    if (find_bone(anatomy, bone->name))
      return fail("key 'name' is used by two bones", file + ": bone '" + bone->name + "'");
    anatomy.bones.push_back(std::move(*bone));
  }
  for (std::size_t i = 0; i < tables.size(); ++i)
    if (auto ok = read_clearances(*tables[i], file, anatomy, i, anatomy.bones[i].clearances); !ok)
      return ok;
  return {};
}

Result<void> read_softs(TomlReader& root, const std::string& file, AnatomyDescription& anatomy) {
  const FindBone find = [&](const std::string& name) { return find_bone(anatomy, name); };
  for (const toml::table* table : root.tables("soft", false)) {
    TomlReader in(*table, where_of(file, "soft part", *table));
    auto soft = read_soft(in, find);
    if (!soft) return tl::unexpected(soft.error());
    if (find_bone(anatomy, soft->name)) return fail("key 'name' is that of a bone", in.where());
    for (const SoftDescription& other : anatomy.softs)
      if (other.name == soft->name) return fail("key 'name' is used by two soft parts", in.where());
    anatomy.softs.push_back(std::move(*soft));
  }
  return {};
}

/// What a landmark moves with, and what it lies on: a bone, which it then moves with, or a soft
/// part.
void read_ground(TomlReader& in, const AnatomyDescription& anatomy, LandmarkDescription& landmark) {
  if (in.has("bone")) {
    const auto bone = find_bone(anatomy, in.text("bone"));
    if (!bone) in.reject(bone.error().what, "bone");
    landmark.bone = bone.value_or(0);
  }
  if (!in.has("on")) return;
  const std::string on = in.text("on");
  if (const auto bone = find_bone(anatomy, on)) {
    if (landmark.bone && *landmark.bone != *bone) in.reject("names a bone other than 'bone'", "on");
    landmark.on_bone = landmark.bone = *bone;
    return;
  }
  for (std::size_t i = 0; i < anatomy.softs.size(); ++i)
    if (anatomy.softs[i].name == on) landmark.on_soft = i;
  if (!landmark.on_soft) in.reject("names no bone and no soft part: '" + on + "'", "on");
}

/// The band that a landmark stays beside.
void read_along(TomlReader& in, const AnatomyDescription& anatomy, LandmarkDescription& landmark) {
  if (!in.has("along")) return;
  const std::string along = in.text("along");
  for (std::size_t i = 0; i < anatomy.softs.size(); ++i)
    if (anatomy.softs[i].name == along &&
        std::holds_alternative<BandDescription>(anatomy.softs[i].shape))
      landmark.along = i;
  if (!landmark.along) in.reject("names no ligament and no tendon: '" + along + "'", "along");
  if (!landmark.bone || landmark.on_bone)
    in.reject("is for a landmark that goes with a bone and does not lie on one", "along");
}

Result<void> read_landmarks(TomlReader& root, const std::string& file,
                            AnatomyDescription& anatomy) {
  for (const toml::table* table : root.tables("landmark", false)) {
    TomlReader in(*table, where_of(file, "landmark", *table));
    LandmarkDescription landmark;
    landmark.name = in.text("name");
    landmark.p_W = in.vec3("position_mm", kPlace_mm) * kMm;
    read_ground(in, anatomy, landmark);
    read_along(in, anatomy, landmark);
    for (const LandmarkDescription& other : anatomy.landmarks)
      if (other.name == landmark.name) in.reject("is used by two landmarks", "name");
    if (auto ok = in.finish(); !ok) return ok;
    anatomy.landmarks.push_back(std::move(landmark));
  }
  return {};
}

Result<void> read_joints(TomlReader& root, const std::string& file, AnatomyDescription& anatomy) {
  for (const toml::table* table : root.tables("joint", false)) {
    TomlReader in(*table, where_of(file, "joint", *table));
    RollingJoint joint = read_joint(in, anatomy);
    for (const RollingJoint& other : anatomy.joints)
      if (other.name == joint.name) in.reject("is used by two joints", "name");
    if (auto ok = in.finish(); !ok) return ok;
    anatomy.joints.push_back(std::move(joint));
  }
  return {};
}

}  // namespace

Result<AnatomyDescription> parse_description(std::string_view text, const std::string& file) {
  const auto table = parse_toml(text, file);
  if (!table) return tl::unexpected(table.error());
  TomlReader root(*table, file);
  AnatomyDescription anatomy;
  anatomy.name = root.text("name");
  anatomy.side = root.text("side");
  if (anatomy.side != "left" && anatomy.side != "right")
    root.reject("must be \"left\" or \"right\"", "side");
  if (auto ok = read_bones(root, file, anatomy); !ok) return tl::unexpected(ok.error());
  if (auto ok = read_softs(root, file, anatomy); !ok) return tl::unexpected(ok.error());
  if (auto ok = read_landmarks(root, file, anatomy); !ok) return tl::unexpected(ok.error());
  if (auto ok = read_joints(root, file, anatomy); !ok) return tl::unexpected(ok.error());
  if (auto ok = root.finish(); !ok) return tl::unexpected(ok.error());
  return anatomy;
}

}  // namespace osteon
