#include "case/case_toml_joints.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "numbers.h"

namespace osteon {
namespace {

constexpr NumberRange kDegrees{-360, 360};
constexpr std::size_t kMostRows = 1000;

std::string read_joined(CaseTomlReader& reader, std::string_view key, const CaseText& out) {
  std::string name = reader.text(key);
  const auto& bones = out.def.bones;
  if (std::none_of(bones.begin(), bones.end(), [&](const BoneDef& b) { return b.name == name; }))
    reader.set_error("there is no bone '" + name + "'", key);
  return name;
}

PoseTrack read_track(CaseTomlReader& reader) {
  PoseTrack track{reader.number("first_deg", kDegrees), reader.number("step_deg", {1e-3, 360}), {}};
  const auto rows = reader.rows_or_empty("poses", 7, {-100, 100});
  if (rows.empty() || rows.size() > kMostRows)
    reader.set_error("'poses' must hold 1 to 1000 rows: position in metres, quaternion w x y z",
                     "poses");
  for (const std::vector<double>& r : rows) {
    const auto unit = as_unit(Quat(r[3], r[4], r[5], r[6]));
    if (!unit)
      reader.set_error("a row's last four numbers must be a quaternion of length 1", "poses");
    track.poses.push_back({Vec3(r[0], r[1], r[2]), unit.value_or(Quat::Identity())});
  }
  return track;
}

void read_joint(const toml::table& table, const std::string& where, CaseText& out,
                CaseTomlReader& file) {
  const std::string title = "joint " + std::to_string(out.def.joints.size() + 1);
  CaseTomlReader reader(table, where, title);
  reader.allow_only({"name", "fixed", "at_deg", "moved"});
  JointDef joint;
  joint.name = reader.text("name");
  joint.fixed = read_joined(reader, "fixed", out);
  joint.at_deg = reader.number("at_deg", kDegrees);
  for (const toml::table* entry : reader.tables_or_empty("moved")) {
    CaseTomlReader moved(*entry, where,
                         title + ", moved " + std::to_string(joint.bones.size() + 1));
    moved.allow_only({"bone", "first_deg", "step_deg", "poses"});
    std::string bone = read_joined(moved, "bone", out);
    joint.bones.push_back({std::move(bone), read_track(moved)});
    reader.adopt_error(moved);
  }
  out.def.joints.push_back(std::move(joint));
  file.adopt_error(reader);
}

/// TOML has no whole numbers beyond 63 bits: a seed is written as text.
std::optional<std::uint64_t> read_seed(CaseTomlReader& reader) {
  if (!reader.has("seed")) return std::nullopt;
  const std::string text = reader.text("seed");
  std::uint64_t seed = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size())
    reader.set_error("'seed' must be a whole number in quotes", "seed");
  return seed;
}

}  // namespace

void read_joints(CaseTomlReader& file, const std::string& where, CaseText& out) {
  for (const toml::table* table : file.tables_or_empty("joints"))
    read_joint(*table, where, out, file);
}

void read_recipe(CaseTomlReader& file, const std::string& where, CaseText& out) {
  const toml::table* table = file.table_or_null("recipe");
  if (!table) return;
  CaseTomlReader reader(*table, where, "recipe");
  reader.allow_only({"anatomy", "seed", "side", "set", "findings"});
  CaseRecipe recipe;
  recipe.anatomy = reader.text("anatomy");
  recipe.seed = read_seed(reader);
  recipe.side = reader.text_or("side", "");
  for (const toml::table* entry : reader.tables_or_empty("set")) {
    CaseTomlReader value(*entry, where, "recipe, set " + std::to_string(recipe.set.size() + 1));
    value.allow_only({"name", "value"});
    std::string name = value.text("name");
    recipe.set.emplace_back(std::move(name), value.number("value", {-1e6, 1e6}));
    reader.adopt_error(value);
  }
  for (const toml::table* entry : reader.tables_or_empty("findings")) {
    CaseTomlReader finding(*entry, where,
                           "recipe, finding " + std::to_string(recipe.findings.size() + 1));
    finding.allow_only({"name", "grade"});
    std::string name = finding.text("name");
    recipe.findings.emplace_back(std::move(name), finding.text("grade"));
    reader.adopt_error(finding);
  }
  out.def.recipe = std::move(recipe);
  file.adopt_error(reader);
}

}  // namespace osteon
