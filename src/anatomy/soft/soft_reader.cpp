#include "soft/soft_reader.h"

#include <algorithm>
#include <cmath>

#include "describe/part_reader.h"

namespace osteon {
namespace {

constexpr Range kThickness_mm{0.05, 100};
constexpr Range kSink_mm{0, 5};

std::size_t read_bone_key(TomlReader& in, const FindBone& find_bone, const std::string& name,
                          const char* key = "bone") {
  const auto bone = find_bone(name);
  if (!bone) in.reject(bone.error().what, key);
  return bone.value_or(0);
}

/// The entry's own bone, else that of the whole soft part.
std::size_t read_bone_or(TomlReader& in, const FindBone& find_bone, const std::string& otherwise) {
  return read_bone_key(in, find_bone,
                       in.has("bone") || otherwise.empty() ? in.text("bone") : otherwise);
}

Result<void> read_bound_parts(TomlReader& soft, const std::string& key, Operation operation,
                              double blend, const std::string& bone, const FindBone& find_bone,
                              std::vector<BoundPart>& parts) {
  std::size_t n = 0;
  for (const toml::table* table : soft.tables(key, false)) {
    TomlReader in(*table, soft.where() + ", " + key + " " + std::to_string(++n));
    BoundPart part;
    part.bone = read_bone_or(in, find_bone, bone);
    if (in.has("along")) part.along = in.text("along");
    if (in.has("to_bone"))
      part.to_bone = read_bone_key(in, find_bone, in.text("to_bone"), "to_bone");
    part.part = read_part(in, operation, blend);
    if (part.to_bone && !std::holds_alternative<Tube>(part.part.primitive))
      in.reject("is for a tube alone", "to_bone");
    if (auto ok = in.finish(); !ok) return ok;
    parts.push_back(std::move(part));
  }
  return {};
}

/// `add` and `cut` of the soft part, which must add something where `required`.
Result<std::vector<BoundPart>> read_solid(TomlReader& soft, const FindBone& find_bone,
                                          bool required) {
  const std::string bone = soft.has("bone") ? soft.text("bone") : "";
  const double blend = soft.number_or("blend_mm", kBlend_mm, 0) * kMm;
  std::vector<BoundPart> parts;
  if (required && !soft.has("add")) soft.reject("is missing", "add");
  if (auto ok = read_bound_parts(soft, "add", Operation::kAdd, blend, bone, find_bone, parts); !ok)
    return tl::unexpected(ok.error());
  if (parts.empty() && soft.has("cut")) soft.reject("cuts something, but 'add' is missing", "cut");
  if (auto ok = read_bound_parts(soft, "cut", Operation::kCut, blend, bone, find_bone, parts); !ok)
    return tl::unexpected(ok.error());
  return parts;
}

Result<LayerDescription> read_layer(TomlReader& in, const FindBone& find_bone) {
  LayerDescription layer;
  layer.bone = read_bone_key(in, find_bone, in.text("bone"));
  for (const std::string& name : in.texts("facing")) {
    layer.facing.push_back(read_bone_key(in, find_bone, name));
    if (layer.facing.back() == layer.bone) in.reject("must be other bones", "facing");
  }
  layer.thickness = in.number("thickness_mm", kThickness_mm) * kMm;
  layer.taper = in.number("taper_mm", kThickness_mm) * kMm;
  layer.rim = in.number_or("rim_mm", kThickness_mm, 0) * kMm;
  layer.clearance = in.number_or("clearance_mm", kSink_mm, 0.1) * kMm;
  if (layer.facing.empty()) {
    if (!in.has("add")) in.reject("is missing, and so is 'facing'", "add");
  } else {
    layer.reach = in.number("reach_mm", kThickness_mm) * kMm;
  }
  auto region = read_solid(in, find_bone, false);
  if (!region) return tl::unexpected(region.error());
  layer.region = std::move(*region);
  return layer;
}

Vec3 read_direction(TomlReader& in, const std::string& key) {
  const Vec3 v = in.vec3(key, {-1, 1});
  const double length = v.norm();
  if (length < 1e-3) in.reject("must not be zero", key);
  return v / std::max(length, 1e-3);
}

/// Points follow each other at least this far apart, so that the band has a direction.
constexpr double kShortestStep_m = 2e-4;

Result<BandDescription> read_band(TomlReader& soft, const FindBone& find_bone) {
  BandDescription band;
  const double width = soft.number("width_mm", kThickness_mm);
  const double thickness = soft.number("thickness_mm", kThickness_mm);
  band.flat_W = read_direction(soft, "flat");
  band.sink = soft.number_or("sink_mm", kSink_mm, 0.4) * kMm;
  const std::vector<const toml::table*> tables = soft.tables("path", true);
  if (tables.size() < 2) soft.reject("must hold two points or more", "path");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    TomlReader in(*tables[i], soft.where() + ", path " + std::to_string(i + 1));
    BandPoint point;
    const std::string bone = in.text("bone");
    point.at.bone = read_bone_key(in, find_bone, bone);
    point.at.p_W = in.vec3("at_mm", kPlace_mm) * kMm;
    point.width = in.number_or("width_mm", kThickness_mm, width) * kMm;
    point.thickness = in.number_or("thickness_mm", kThickness_mm, thickness) * kMm;
    if (point.thickness > point.width) in.reject("must not exceed the width", "thickness_mm");
    point.attached = (i == 0 || i + 1 == tables.size()) && !in.flag_or("free", false);
    point.thins_out = point.attached && !in.has("thickness_mm");
    if (point.attached) point.name = in.has("name") ? in.text("name") : bone;
    if (i > 0 && (point.at.p_W - band.path.back().at.p_W).norm() < kShortestStep_m)
      in.reject("is the same as the point before it", "at_mm");
    if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
    band.path.push_back(std::move(point));
  }
  return band;
}

Result<VolumeDescription> read_volume(TomlReader& in, const FindBone& find_bone) {
  VolumeDescription volume;
  volume.sink = in.number_or("sink_mm", kSink_mm, 0) * kMm;
  volume.least = in.number_or("least_mm", kSink_mm, 0) * kMm;
  volume.clear_of = in.texts("clear_of");
  auto parts = read_solid(in, find_bone, true);
  if (!parts) return tl::unexpected(parts.error());
  volume.parts = std::move(*parts);
  return volume;
}

Result<SkinDescription> read_skin(TomlReader& in, const FindBone& find_bone) {
  SkinDescription skin;
  skin.offset = in.number("offset_mm", kThickness_mm) * kMm;
  skin.blend = in.number_or("skin_blend_mm", kBlend_mm, 0) * kMm;
  auto parts = read_solid(in, find_bone, true);
  if (!parts) return tl::unexpected(parts.error());
  skin.parts = std::move(*parts);
  return skin;
}

struct ShapeOfKind {
  const char* kind;
  Result<void> (*read)(TomlReader&, const FindBone&, SoftDescription&);
};

template <auto read>
Result<void> read_into(TomlReader& in, const FindBone& find_bone, SoftDescription& soft) {
  auto shape = read(in, find_bone);
  if (!shape) return tl::unexpected(shape.error());
  soft.shape = std::move(*shape);
  return {};
}

constexpr ShapeOfKind kKinds[] = {
    {"cartilage", read_into<read_layer>}, {"ligament", read_into<read_band>},
    {"tendon", read_into<read_band>},     {"disc", read_into<read_volume>},
    {"meniscus", read_into<read_volume>}, {"fat", read_into<read_volume>},
    {"skin", read_into<read_skin>}};

}  // namespace

Result<SoftDescription> read_soft(TomlReader& in, const FindBone& find_bone) {
  SoftDescription soft;
  soft.name = in.text("name");
  if (in.has("fma_id")) soft.fma_id = in.integer("fma_id", 1, 999999999);
  soft.tissue = in.text("tissue");
  soft.kind = in.text("kind");
  soft.cell = in.number_or("cell_mm", kCell_mm, soft.cell / kMm) * kMm;
  const auto* known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const ShapeOfKind& k) { return soft.kind == k.kind; });
  if (known == std::end(kKinds))
    in.reject("names no known kind: '" + soft.kind + "'", "kind");
  else if (auto ok = known->read(in, find_bone, soft); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
  return soft;
}

std::size_t carrier(const SoftDescription& soft) {
  struct First {
    std::size_t operator()(const LayerDescription& s) const { return s.bone; }
    std::size_t operator()(const BandDescription& s) const { return s.path[0].at.bone; }
    std::size_t operator()(const VolumeDescription& s) const { return s.parts[0].bone; }
    std::size_t operator()(const SkinDescription& s) const { return s.parts[0].bone; }
  };
  return std::visit(First{}, soft.shape);
}

}  // namespace osteon
