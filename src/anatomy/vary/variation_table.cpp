#include "vary/variation_table.h"

#include <algorithm>

#include "describe/toml_reader.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr Range kPlace_mm{-2000, 2000};
constexpr Range kValue{-1e4, 1e4};

StepTargets read_targets(TomlReader& in) {
  StepTargets targets{in.texts("bones"), in.texts("landmarks"), in.texts("parts")};
  if (targets.bones.empty() && targets.landmarks.empty())
    in.reject("is missing, and so is 'landmarks'", "bones");
  if (targets.bones.empty() && !targets.parts.empty())
    in.reject("must name the bone of the parts", "bones");
  return targets;
}

TurnStep read_turn(TomlReader& in) {
  TurnStep step;
  step.targets = read_targets(in);
  step.degrees_per_unit = in.vec3("degrees", {-10, 10});
  step.pivot_W = in.vec3("pivot_mm", kPlace_mm) * kMm;
  step.full_x = in.number("full_x_mm", kPlace_mm) * kMm;
  step.none_x = in.number("none_x_mm", kPlace_mm) * kMm;
  if (step.none_x - step.full_x < 1e-3)
    in.reject("must lie 1 mm or more above full_x_mm", "none_x_mm");
  return step;
}

ShiftStep read_shift(TomlReader& in) {
  ShiftStep step;
  step.targets = read_targets(in);
  step.metres_per_unit = in.vec3("mm", {-100, 100}) * kMm;
  return step;
}

ScaleStep read_scale(TomlReader& in) {
  ScaleStep step;
  step.targets = read_targets(in);
  step.center_W = in.vec3("center_mm", kPlace_mm) * kMm;
  step.share_per_unit = in.number("percent", {-10, 10}) / 100;
  return step;
}

VariationParameter read_parameter(TomlReader& in) {
  VariationParameter p;
  p.name = in.text("name");
  p.mean = in.number("mean", kValue);
  p.sd = in.number("sd", {0, 1e4});
  p.min = in.number("min", kValue);
  p.max = in.number("max", kValue);
  p.built_in = in.number("built_in", kValue);
  p.source = in.text("source");
  p.meaning = in.text("meaning");
  if (p.mean < p.min || p.mean > p.max) in.reject("must lie between 'min' and 'max'", "mean");
  if (p.built_in < p.min || p.built_in > p.max)
    in.reject("must lie between 'min' and 'max'", "built_in");
  return p;
}

Result<VariationRule> read_variation_rule(const toml::table& table, const std::string& file) {
  TomlReader in(table, file + ": parameter at line " + std::to_string(table.source().begin.line));
  VariationRule rule;
  rule.parameter = read_parameter(in);
  if (auto ok = read_entries(in, "turn", read_turn, rule.turns); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "shift", read_shift, rule.shifts); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = read_entries(in, "scale", read_scale, rule.scales); !ok)
    return tl::unexpected(ok.error());
  if (in.has("joint")) rule.joint = in.text("joint");
  if (!rule.joint.empty() && rule.parameter.sd != 0)
    in.reject("must be 0: the flexion of a joint is never drawn at random", "sd");
  if (auto ok = in.finish(); !ok) return tl::unexpected(ok.error());
  return rule;
}

}  // namespace

Result<VariationTable> parse_variation(std::string_view text, const std::string& file) {
  const auto toml = parse_toml(text, file);
  if (!toml) return tl::unexpected(toml.error());
  TomlReader root(*toml, file);
  VariationTable table;
  table.file = file;
  const std::string size_name = root.text("overall_size");
  for (const toml::table* entry : root.tables("parameter", true)) {
    auto rule = read_variation_rule(*entry, file);
    if (!rule) return tl::unexpected(rule.error());
    for (const VariationRule& other : table.rules)
      if (other.parameter.name == rule->parameter.name)
        return fail("key 'name' is used by two parameters: '" + rule->parameter.name + "'", file);
    table.rules.push_back(std::move(*rule));
  }
  const auto size = std::find_if(table.rules.begin(), table.rules.end(), [&](const auto& rule) {
    return rule.parameter.name == size_name;
  });
  if (size == table.rules.end() || size->scales.size() != 1)
    root.reject("must name a parameter of one scale", "overall_size");
  table.overall_size = static_cast<std::size_t>(size - table.rules.begin());
  if (auto ok = root.finish(); !ok) return tl::unexpected(ok.error());
  return table;
}

Result<VariationTable> load_variation(const std::filesystem::path& file) {
  const auto text = read_file(file, 1 << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_variation(*text, file.string());
}

}  // namespace osteon
