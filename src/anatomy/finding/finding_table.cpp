#include "finding/finding_table.h"

#include <algorithm>

#include "describe/part_reader.h"
#include "describe/toml_reader.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr Range kShift_mm{-50, 50};

CutStep read_cut(TomlReader& in) {
  CutStep step;
  step.of = in.text("of");
  step.bone = in.has("bone") ? in.text("bone") : step.of;
  if (in.has("cell_mm")) step.coarsest_cell = in.number("cell_mm", kCell_mm) * kMm;
  if (in.has("pieces")) step.pieces = static_cast<std::size_t>(in.integer("pieces", 1, 8));
  step.part = read_part(in, Operation::kCut, 0);
  return step;
}

ThinStep read_thin(TomlReader& in) {
  const std::string of = in.text("of");
  return {of, in.number("percent", {5, 100}) / 100};
}

MoveStep read_move(TomlReader& in) {
  MoveStep step;
  step.bones = in.texts("bones");
  if (step.bones.empty()) in.reject("must name a bone", "bones");
  step.shift_W = in.vec3_or("mm", kShift_mm, Vec3::Zero()) * kMm;
  step.R_W = rotation_xyz_deg(in.vec3_or("turn_deg", kAngle_deg, Vec3::Zero()));
  step.pivot_W = in.vec3_or("pivot_mm", kPlace_mm, Vec3::Zero()) * kMm;
  if (in.has("turn_deg") && !in.has("pivot_mm")) in.reject("is missing", "pivot_mm");
  return step;
}

SplitStep read_split(TomlReader& in) {
  SplitStep step;
  step.bone = in.text("bone");
  std::size_t n = 0;
  for (const toml::table* table : in.tables("into", true)) {
    TomlReader entry(*table, in.where() + ", into " + std::to_string(++n));
    SplitStep::Into into;
    into.name = entry.text("name");
    into.near_W = entry.vec3("near_mm", kPlace_mm) * kMm;
    if (const auto ok = entry.finish(); !ok) in.reject(ok.error().what, "into");
    step.into.push_back(std::move(into));
  }
  if (step.into.size() < 2) in.reject("must hold two fragments or more", "into");
  return step;
}

MarkStep read_mark(TomlReader& in) {
  MarkStep step;
  step.name = in.text("name");
  step.bone = in.text("bone");
  step.p_W = in.vec3("position_mm", kPlace_mm) * kMm;
  return step;
}

Result<FindingSteps> read_steps(TomlReader& in) {
  FindingSteps steps;
  if (auto ok = read_entries(in, "cut", read_cut, steps.cuts); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "thin", read_thin, steps.thins); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "move", read_move, steps.moves); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "split", read_split, steps.splits); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "mark", read_mark, steps.marks); !ok)
    return tl::unexpected(ok.error());
  if (steps.cuts.empty() && steps.thins.empty() && steps.moves.empty())
    in.reject("is missing, and so are 'thin' and 'move': the grade changes nothing", "cut");
  return steps;
}

Result<void> read_grade(const toml::table& table, const std::string& where, FindingRule& rule) {
  FindingGrade grade;
  const auto named = table["name"].value<std::string>();
  TomlReader in(table, where + ", grade '" + named.value_or("?") + "'");
  grade.name = in.text("name");
  grade.meaning = in.text("meaning");
  for (const FindingGrade& other : rule.finding.grades)
    if (other.name == grade.name) in.reject("is used by two grades", "name");
  auto steps = read_steps(in);
  if (!steps) return tl::unexpected(steps.error());
  rule.finding.grades.push_back(std::move(grade));
  rule.steps.push_back(std::move(*steps));
  return in.finish();
}

Result<FindingRule> read_finding_rule(const toml::table& table, const std::string& file) {
  const auto named = table["name"].value<std::string>();
  TomlReader in(table, file + ": finding '" + named.value_or("?") + "'");
  FindingRule rule;
  rule.finding.name = in.text("name");
  rule.finding.meaning = in.text("meaning");
  rule.finding.source = in.text("source");
  for (const toml::table* grade : in.tables("grade", true))
    if (auto ok = read_grade(*grade, in.where(), rule); !ok) return tl::unexpected(ok.error());
  if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
  return rule;
}

}  // namespace

Result<FindingTable> parse_findings(std::string_view text, const std::string& file) {
  const auto toml = parse_toml(text, file);
  if (!toml) return tl::unexpected(toml.error());
  TomlReader root(*toml, file);
  FindingTable table;
  table.file = file;
  for (const toml::table* entry : root.tables("finding", true)) {
    auto rule = read_finding_rule(*entry, file);
    if (!rule) return tl::unexpected(rule.error());
    for (const FindingRule& other : table.rules)
      if (other.finding.name == rule->finding.name)
        return fail("key 'name' is used by two findings: '" + rule->finding.name + "'", file);
    table.rules.push_back(std::move(*rule));
  }
  if (auto ok = root.finish(); !ok) return tl::unexpected(ok.error());
  return table;
}

Result<FindingTable> load_findings(const std::filesystem::path& file) {
  const auto text = read_file(file, 1 << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_findings(*text, file.string());
}

Result<std::vector<AnatomyFinding>> list_findings(const std::filesystem::path& table) {
  const auto loaded = load_findings(table);
  if (!loaded) return tl::unexpected(loaded.error());
  std::vector<AnatomyFinding> findings;
  for (const FindingRule& rule : loaded->rules) findings.push_back(rule.finding);
  return findings;
}

}  // namespace osteon
