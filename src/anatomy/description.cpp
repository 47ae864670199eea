#include "description.h"

#include <algorithm>

#include "toml_reader.h"

namespace osteon {
namespace {

constexpr double kMm = 0.001;
constexpr Range kPlace_mm{-2000, 2000};
constexpr Range kRadius_mm{0.1, 1000};
constexpr Range kBlend_mm{0, 100};
constexpr Range kCell_mm{0.1, 10};
constexpr Range kAngle_deg{-360, 360};

/// Turns bone directions into the axes of a part that the description turns by `rotation_deg`.
Mat3 local_axes(TomlReader& in) {
  return rotation_xyz_deg(in.vec3_or("rotation_deg", kAngle_deg, Vec3::Zero())).transpose();
}

Primitive read_ellipsoid(TomlReader& in) {
  Ellipsoid e;
  e.center = in.vec3("center_mm", kPlace_mm) * kMm;
  e.radii = in.vec3("radii_mm", kRadius_mm) * kMm;
  e.R_local = local_axes(in);
  return e;
}

Primitive read_tube(TomlReader& in) {
  std::vector<Vec3> points = in.points("points_mm", kPlace_mm);
  std::vector<double> radii = in.numbers("radii_mm", kRadius_mm);
  if (points.size() != radii.size()) in.reject("must hold one radius a point", "radii_mm");
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - points[i - 1]).norm() < 1e-3)
      in.reject("holds the same point twice in a row", "points_mm");
  if (in.failed()) return {};
  for (Vec3& p : points) p *= kMm;
  for (double& r : radii) r *= kMm;
  Tube tube = tube_through(points, radii);
  if (*std::min_element(tube.radii.begin(), tube.radii.end()) <= 0)
    in.reject("swing so hard that the curve through them falls below zero", "radii_mm");
  return tube;
}

Primitive read_box(TomlReader& in) {
  RoundedBox b;
  b.center = in.vec3("center_mm", kPlace_mm) * kMm;
  b.half = in.vec3("half_mm", kRadius_mm) * kMm;
  b.round = in.number("round_mm", kBlend_mm) * kMm;
  b.R_local = local_axes(in);
  if (b.round > b.half.minCoeff()) in.reject("must not exceed the smallest of half_mm", "round_mm");
  return b;
}

Primitive read_half_space(TomlReader& in) {
  HalfSpace h;
  h.point = in.vec3("point_mm", kPlace_mm) * kMm;
  h.normal = in.vec3("normal", {-1, 1});
  const double length = h.normal.norm();
  if (length < 1e-3) in.reject("must not be zero", "normal");
  h.normal /= std::max(length, 1e-3);
  return h;
}

struct ShapeReader {
  const char* name;
  Primitive (*read)(TomlReader&);
  bool has_end;
};

constexpr ShapeReader kShapes[] = {{"ellipsoid", read_ellipsoid, true},
                                   {"tube", read_tube, true},
                                   {"box", read_box, true},
                                   {"half_space", read_half_space, false}};

Result<Part> read_part(const toml::table& table, Operation operation, double blend,
                       const std::string& where) {
  TomlReader in(table, where);
  Part part;
  part.operation = operation;
  if (in.has("name")) part.name = in.text("name");
  const std::string shape = in.text("shape");
  const auto* known = std::find_if(std::begin(kShapes), std::end(kShapes),
                                   [&](const ShapeReader& s) { return shape == s.name; });
  if (known == std::end(kShapes)) {
    in.reject("names no shape that is known: '" + shape + "'", "shape");
  } else if (operation == Operation::kAdd && !known->has_end) {
    in.reject("can only cut, not add: '" + shape + "'", "shape");
  } else {
    part.primitive = known->read(in);
  }
  part.blend = in.number_or("blend_mm", kBlend_mm, blend / kMm) * kMm;
  if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
  return part;
}

Result<void> read_parts(TomlReader& in, const std::string& key, Operation operation, double blend,
                        Solid& solid) {
  std::size_t n = 0;
  for (const toml::table* table : in.tables(key, operation == Operation::kAdd)) {
    auto part =
        read_part(*table, operation, blend, in.where() + ", " + key + " " + std::to_string(++n));
    if (!part) return tl::unexpected(part.error());
    solid.parts.push_back(*part);
  }
  return {};
}

std::string where_of(const std::string& file, const char* kind, const toml::table& table) {
  const auto name = table["name"].value<std::string>();
  return file + ": " + kind + " " +
         (name ? "'" + *name + "'" : "at line " + std::to_string(table.source().begin.line));
}

Result<BoneDescription> read_bone(const toml::table& table, const std::string& file) {
  TomlReader in(table, where_of(file, "bone", table));
  BoneDescription bone;
  bone.name = in.text("name");
  bone.fma_id = in.integer("fma_id", 1, 999999999);
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

Result<void> read_landmarks(TomlReader& root, const std::string& file,
                            AnatomyDescription& anatomy) {
  for (const toml::table* table : root.tables("landmark", false)) {
    TomlReader in(*table, where_of(file, "landmark", *table));
    LandmarkDescription landmark;
    landmark.name = in.text("name");
    landmark.p_W = in.vec3("position_mm", kPlace_mm) * kMm;
    for (const LandmarkDescription& other : anatomy.landmarks)
      if (other.name == landmark.name) in.reject("is used by two landmarks", "name");
    if (auto ok = in.finish(); !ok) return ok;
    anatomy.landmarks.push_back(std::move(landmark));
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
  if (auto ok = read_landmarks(root, file, anatomy); !ok) return tl::unexpected(ok.error());
  if (auto ok = root.finish(); !ok) return tl::unexpected(ok.error());
  return anatomy;
}

}  // namespace osteon
