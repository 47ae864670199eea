#include "osteon/tissue/ligament_table.h"

#include <algorithm>

#include "osteon/base/file.h"
#include "scene_reader.h"

namespace osteon {
namespace {

using Keys = SceneReader::Table;

std::vector<Vec3> places(SceneReader& in, const Keys& keys, std::string_view key) {
  std::vector<Vec3> out = in.points(keys, key, {-200, 200});
  for (Vec3& p : out) p *= kMm;
  return out;
}

LigamentBundle read_bundle(SceneReader& in, const Keys& keys) {
  in.only(keys,
          {"name", "femur_mm", "tibia_mm", "stiffness_n", "taut_deg", "strain", "most_strain"});
  LigamentBundle out;
  out.name = in.text(keys, "name");
  out.femur = places(in, keys, "femur_mm");
  out.tibia = places(in, keys, "tibia_mm");
  if (out.femur.empty() || out.femur.size() != out.tibia.size())
    in.complain("must have as many places as femur_mm, and at least one", keys, "tibia_mm");
  out.stiffness_n = in.number(keys, "stiffness_n", {1, 1e6});
  out.taut_deg = in.number(keys, "taut_deg", {0, 130});
  out.strain = in.number(keys, "strain", {-0.5, 0.2});
  out.most_strain = in.number_or(keys, "most_strain", {0, 1}, 1);
  return out;
}

LigamentRow read_ligament(SceneReader& in, const Keys& keys) {
  in.only(keys, {"name", "part", "over_tibia", "failure_n", "bundle"});
  LigamentRow out;
  out.name = in.text(keys, "name");
  if (SceneReader::has(keys, "part")) out.part = in.text(keys, "part");
  out.over_tibia = in.number_or(keys, "over_tibia", {0, 1}, 0) > 0;
  out.failure_n = in.number_or(keys, "failure_n", {1, 1e5}, out.failure_n);
  for (const Keys& bundle : in.tables(keys, "bundle"))
    out.bundles.push_back(read_bundle(in, bundle));
  if (out.bundles.empty()) in.complain("needs at least one bundle", keys, "name");
  return out;
}

TornRow read_torn(SceneReader& in, const Keys& keys) {
  in.only(keys, {"finding", "grade", "ligament", "left"});
  TornRow out;
  out.finding = in.text(keys, "finding");
  if (SceneReader::has(keys, "grade")) out.grade = in.text(keys, "grade");
  out.ligament = in.text(keys, "ligament");
  out.left = in.number(keys, "left", {0, 1});
  return out;
}

LaxityTestRow read_test(SceneReader& in, const Keys& keys) {
  in.only(keys, {"name", "flexion_deg", "anterior_n", "varus_nm", "internal_nm"});
  LaxityTestRow out;
  out.name = in.text(keys, "name");
  out.flexion_deg = in.number(keys, "flexion_deg", {0, 130});
  out.anterior_n = in.number_or(keys, "anterior_n", {-1000, 1000}, 0);
  out.varus_nm = in.number_or(keys, "varus_nm", {-50, 50}, 0);
  out.internal_nm = in.number_or(keys, "internal_nm", {-50, 50}, 0);
  return out;
}

GraftRow read_graft(SceneReader& in, const Keys& keys) {
  in.only(keys, {"ligament", "diameter_mm", "young_mpa", "fixation_n_per_mm", "tension_n",
                 "flexion_deg", "kept"});
  GraftRow out;
  out.ligament = in.text(keys, "ligament");
  out.diameter_m = kMm * in.number(keys, "diameter_mm", {1, 20});
  out.young_pa = 1e6 * in.number(keys, "young_mpa", {1, 2000});
  out.fixation_n_per_m = 1e3 * in.number(keys, "fixation_n_per_mm", {1, 1e5});
  out.tension_n = in.number(keys, "tension_n", {1, 500});
  out.flexion_deg = in.number(keys, "flexion_deg", {0, 130});
  out.kept = in.number(keys, "kept", {0, 1});
  return out;
}

bool has_row(const LigamentTable& table, const std::string& name) {
  return std::any_of(table.ligaments.begin(), table.ligaments.end(),
                     [&](const LigamentRow& row) { return row.name == name; });
}

// Every ligament that is named is one of the table.
void check_torn(SceneReader& in, const Keys& root, const LigamentTable& table) {
  for (const TornRow& row : table.torn)
    if (!has_row(table, row.ligament))
      in.complain("names no ligament: '" + row.ligament + "'", root, "torn");
}

void check_names(SceneReader& in, const Keys& root, const LigamentTable& table) {
  check_torn(in, root, table);
  if (!has_row(table, table.graft.ligament))
    in.complain("names no ligament: '" + table.graft.ligament + "'", root, "graft");
}

LigamentBundle read_felt_bundle(SceneReader& in, const Keys& keys) {
  in.only(keys, {"name", "stiffness_n", "strain"});
  LigamentBundle out;
  out.name = in.text(keys, "name");
  out.stiffness_n = in.number(keys, "stiffness_n", {1, 1e6});
  out.strain = in.number(keys, "strain", {-0.5, 0.2});
  return out;
}

LigamentRow read_felt_ligament(SceneReader& in, const Keys& keys) {
  in.only(keys, {"name", "part", "over", "failure_n", "bundle"});
  LigamentRow out;
  out.name = in.text(keys, "name");
  out.part = in.text(keys, "part");
  if (SceneReader::has(keys, "over")) out.over_bone = in.text(keys, "over");
  out.failure_n = in.number(keys, "failure_n", {1, 1e5});
  for (const Keys& bundle : in.tables(keys, "bundle"))
    out.bundles.push_back(read_felt_bundle(in, bundle));
  if (out.bundles.empty()) in.complain("needs at least one bundle", keys, "name");
  return out;
}

TornRow read_felt_torn(SceneReader& in, const Keys& keys) {
  in.only(keys, {"finding", "grade", "ligament", "left", "strain"});
  TornRow out;
  out.finding = in.text(keys, "finding");
  if (SceneReader::has(keys, "grade")) out.grade = in.text(keys, "grade");
  out.ligament = in.text(keys, "ligament");
  out.left = in.number(keys, "left", {0, 1});
  if (SceneReader::has(keys, "strain")) out.strain = in.number(keys, "strain", {-0.5, 0.2});
  return out;
}

DiscRow read_disc(SceneReader& in, const Keys& keys) {
  in.only(keys, {"part", "young_kpa", "tension_kpa"});
  DiscRow out;
  out.part = in.text(keys, "part");
  out.young_pa = 1e3 * in.number(keys, "young_kpa", {1, 1e5});
  out.tension_pa = 1e3 * in.number(keys, "tension_kpa", {0, 1e5});
  return out;
}

LigamentTable read_felt(SceneReader& in, const Keys& root) {
  in.only(root, {"toe_strain", "disc", "ligament", "torn"});
  LigamentTable out;
  out.toe_strain = in.number(root, "toe_strain", {1e-4, 0.2});
  if (SceneReader::has(root, "disc")) out.disc = read_disc(in, in.table(root, "disc"));
  for (const Keys& keys : in.tables(root, "ligament"))
    out.ligaments.push_back(read_felt_ligament(in, keys));
  for (const Keys& keys : in.tables(root, "torn")) out.torn.push_back(read_felt_torn(in, keys));
  check_torn(in, root, out);
  return out;
}

LigamentTable read_table(SceneReader& in, const Keys& root) {
  in.only(root, {"width_mm", "toe_strain", "seating_n", "cartilage", "surround", "graft",
                 "ligament", "torn", "test"});
  LigamentTable out;
  out.width_m = kMm * in.number(root, "width_mm", {10, 200});
  out.toe_strain = in.number(root, "toe_strain", {1e-4, 0.2});
  out.seating_n = in.number(root, "seating_n", {0, 1000});
  const Keys cartilage = in.table(root, "cartilage"), surround = in.table(root, "surround");
  in.only(cartilage, {"young_mpa", "poisson"});
  out.cartilage_young_pa = 1e6 * in.number(cartilage, "young_mpa", {0.1, 1000});
  out.cartilage_poisson = in.number(cartilage, "poisson", {0, 0.49});
  out.across_n_per_m = 1e3 * in.number(surround, "across_n_per_mm", {0, 1000});
  in.only(surround, {"n_per_mm", "across_n_per_mm", "nm_per_deg"});
  out.surround_n_per_m = 1e3 * in.number(surround, "n_per_mm", {0, 100});
  out.surround_nm_per_rad = 57.29577951308232 * in.number(surround, "nm_per_deg", {0, 10});
  out.graft = read_graft(in, in.table(root, "graft"));
  for (const Keys& keys : in.tables(root, "ligament"))
    out.ligaments.push_back(read_ligament(in, keys));
  for (const Keys& keys : in.tables(root, "torn")) out.torn.push_back(read_torn(in, keys));
  for (const Keys& keys : in.tables(root, "test")) out.tests.push_back(read_test(in, keys));
  check_names(in, root, out);
  return out;
}

template <class Read>
Result<LigamentTable> load_by(const std::filesystem::path& file, const char* remedy, Read&& read) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  try {
    const toml::table root = toml::parse(*text, file.string());
    SceneReader in(file.string());
    LigamentTable table = read(in, Keys{&root, ""});
    if (in.error()) return tl::unexpected(*in.error());
    return table;
  } catch (const toml::parse_error& error) {
    return fail(std::string(error.description()),
                file.string() + ", line " + std::to_string(error.source().begin.line), remedy);
  }
}

}  // namespace

Result<LigamentTable> load_ligament_table(const std::filesystem::path& file) {
  return load_by(file, "See docs/laxity.md", read_table);
}

Result<LigamentTable> load_felt_table(const std::filesystem::path& file) {
  return load_by(file, "See docs/tissue.md", read_felt);
}

}  // namespace osteon
