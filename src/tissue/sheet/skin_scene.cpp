#include "osteon/tissue/skin_scene.h"

#include <cmath>

#include "scene_reader.h"

namespace osteon {
namespace {

using Table = SceneReader::Table;

std::optional<SheetPoint> two(const toml::node* node) {
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->size() != 2) return {};
  SheetPoint out;
  for (std::size_t i = 0; i < 2; ++i) {
    const toml::node* one = list->get(i);
    const auto value = one->is_number() ? one->value<double>() : std::nullopt;
    if (!value || !(std::abs(*value) <= 1e4)) return {};
    out[static_cast<Eigen::Index>(i)] = kMm * *value;
  }
  return out;
}

SheetPoint read_point(SceneReader& in, const Table& t, std::string_view key) {
  const auto p = two(t.keys->get(key));
  if (!p) in.complain("must be two numbers in mm: [x, y]", t, key);
  return p.value_or(SheetPoint::Zero());
}

std::vector<SheetPoint> read_skin_stroke(SceneReader& in, const Table& t, std::string_view key) {
  std::vector<SheetPoint> out;
  const toml::node* node = t.keys->get(key);
  const toml::array* list = node ? node->as_array() : nullptr;
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const auto p = two(list->get(i));
    if (!p) break;
    out.push_back(*p);
  }
  if (!list || out.size() != list->size() || out.size() < 2) {
    in.complain("must be two points or more, each [x, y] in mm", t, key);
    return {SheetPoint::Zero(), SheetPoint::Zero()};
  }
  return out;
}

SheetMaterial read_skin_material(SceneReader& in, const Table& t) {
  in.only(t, {"young_kpa", "thickness_mm", "poisson", "tension_n_per_m", "fat_kpa_per_mm", "fat_mm",
              "tether_kpa_per_mm", "friction", "pierce_kpa", "fat_pierce_kpa"});
  SheetMaterial m;
  m.thickness_m = kMm * in.number_or(t, "thickness_mm", {0.1, 100}, m.thickness_m / kMm);
  m.stretch_n_per_m = m.thickness_m * 1000 * in.number_or(t, "young_kpa", {0.1, 1e7}, 500);
  m.poisson = in.number_or(t, "poisson", {0, 0.4999}, m.poisson);
  m.tension_n_per_m = in.number_or(t, "tension_n_per_m", {1e-3, 1e5}, m.tension_n_per_m);
  constexpr double kPerMm = 1e6;  // kPa/mm in Pa/m
  m.foundation_n_per_m3 =
      kPerMm * in.number_or(t, "fat_kpa_per_mm", {0.001, 1e4}, m.foundation_n_per_m3 / kPerMm);
  m.fat_m = kMm * in.number_or(t, "fat_mm", {0.1, 1e4}, m.fat_m / kMm);
  m.tether_n_per_m3 =
      kPerMm * in.number_or(t, "tether_kpa_per_mm", {1e-5, 1e4}, m.tether_n_per_m3 / kPerMm);
  m.friction = in.number_or(t, "friction", {0, 10}, m.friction);
  m.pierce_pa = 1000 * in.number_or(t, "pierce_kpa", {0.01, 1e6}, m.pierce_pa / 1000);
  m.fat_pierce_pa = 1000 * in.number_or(t, "fat_pierce_kpa", {0, 1e6}, m.fat_pierce_pa / 1000);
  if (m.tension_n_per_m > 0.5 * m.stretch_n_per_m)
    in.complain("is more than half of young_kpa x thickness_mm: small strains no longer hold", t,
                "tension_n_per_m", "Use less tension or stiffer skin");
  return m;
}

SheetDisc read_disc(SceneReader& in, const Table& t) {
  SheetDisc out;
  out.p = read_point(in, t, "at_mm");
  out.radius_m = kMm * in.number_or(t, "radius_mm", {0.05, 100}, out.radius_m / kMm);
  return out;
}

void read_sheet(SceneReader& in, const Table& t, SkinScene& scene) {
  in.only(t, {"size_mm", "edge_mm"});
  const SheetPoint size = read_point(in, t, "size_mm");
  scene.edge_m = kMm * in.number_or(t, "edge_mm", {0.05, 100}, 1.5);
  scene.width_m = size.x();
  scene.height_m = size.y();
}

SkinPlace read_place(SceneReader& in, const Table& t) {
  constexpr double kDegree = 3.141592653589793 / 180;
  in.only(t, {"case", "at", "near_mm", "turn_deg"});
  SkinPlace out;
  out.the_case = in.text(t, "case");
  if (SceneReader::has(t, "at") == SceneReader::has(t, "near_mm"))
    in.complain("must come alone: a landmark's name, or a point as near_mm", t, "at");
  if (SceneReader::has(t, "at"))
    out.landmark = in.text(t, "at");
  else
    out.near_W = kMm * in.vec3(t, "near_mm", {-1e4, 1e4});
  out.turn_rad = kDegree * in.number_or(t, "turn_deg", {-360, 360}, 0);
  return out;
}

SkinScene read_skin(SceneReader& in, const Table& root) {
  in.only(root, {"sheet", "place", "material", "cut", "press", "pierce"});
  SkinScene scene;
  read_sheet(in, in.table(root, "sheet"), scene);
  if (SceneReader::has(root, "place")) scene.place = read_place(in, in.table(root, "place"));
  if (SceneReader::has(root, "material"))
    scene.material = read_skin_material(in, in.table(root, "material"));
  for (const Table& t : in.tables(root, "cut")) {
    in.only(t, {"points_mm", "depth_mm"});
    scene.cuts.push_back(
        {read_skin_stroke(in, t, "points_mm"),
         kMm * in.number_or(t, "depth_mm", {0.01, 1000}, 2.5 * scene.material.thickness_m / kMm)});
  }
  for (const Table& t : in.tables(root, "press")) {
    in.only(t, {"at_mm", "radius_mm", "force_n"});
    scene.presses.push_back({read_disc(in, t), in.number(t, "force_n", {0, 1e4})});
  }
  for (const Table& t : in.tables(root, "pierce")) {
    in.only(t, {"at_mm", "radius_mm", "depth_mm", "speed_mm_per_s"});
    scene.pierces.push_back({read_disc(in, t), kMm * in.number(t, "depth_mm", {0.1, 1000}),
                             kMm * in.number_or(t, "speed_mm_per_s", {0.1, 1000}, 20)});
  }
  return scene;
}

}  // namespace

Result<SkinScene> parse_skin_scene(std::string_view text, const std::string& name) {
  const auto root = parse_scene_toml(text, name);
  if (!root) return tl::unexpected(root.error());
  SceneReader in(name);
  SkinScene scene = read_skin(in, {&*root, ""});
  scene.name = name;
  if (in.error()) return tl::unexpected(*in.error());
  return scene;
}

Result<SkinScene> load_skin_scene(const std::filesystem::path& path) {
  const auto text = read_scene_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_skin_scene(*text, path.string());
}

}  // namespace osteon
