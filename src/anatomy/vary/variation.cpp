#include "osteon/anatomy/variation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bone/bone_places.h"
#include "bone/grow.h"
#include "bone/overlap.h"
#include "finding/apply_findings.h"
#include "joint/roll_glide.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "recognise/split_bones.h"
#include "soft/skin_places.h"
#include "soft/soft_grow.h"
#include "vary/vary.h"

namespace osteon {
namespace {

constexpr int kMostHalvings = 4;

/// Two digits, so that a value that is shown can be given again.
double rounded(double v) { return std::round(v * 100) / 100; }

std::string two_digits(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

std::string names_and_ranges(const VariationTable& table) {
  std::string text = "Parameters:";
  for (const VariationRule& rule : table.rules) {
    const VariationParameter& p = rule.parameter;
    text += (&rule == &table.rules[0] ? " " : ", ") + p.name + " " + two_digits(p.min) + " to " +
            two_digits(p.max);
  }
  return text;
}

/// A value a rule, and which of them may be moved.
struct Drawn {
  std::vector<double> values;
  std::vector<bool> free;
};

Drawn draw(const VariationTable& table, const VariationRequest& request) {
  Drawn drawn;
  Random random(request.seed.value_or(0));
  for (const VariationRule& rule : table.rules) {
    const VariationParameter& p = rule.parameter;
    const double value =
        request.seed ? std::clamp(rounded(random.normal(p.mean, p.sd)), p.min, p.max) : p.built_in;
    drawn.values.push_back(value);
    drawn.free.push_back(request.seed.has_value());
  }
  return drawn;
}

Result<void> set_one(const VariationTable& table, const ParameterValue& set, Drawn& drawn) {
  const auto& [name, value] = set;
  for (std::size_t i = 0; i < table.rules.size(); ++i) {
    const VariationParameter& p = table.rules[i].parameter;
    if (p.name != name) continue;
    if (!(value >= p.min && value <= p.max))  // also refuses what is not a number
      return fail("must lie between " + two_digits(p.min) + " and " + two_digits(p.max) +
                      ", not be " + two_digits(value),
                  "parameter '" + name + "'", names_and_ranges(table));
    drawn.values[i] = value;
    drawn.free[i] = false;
    return {};
  }
  return fail("is not known", "parameter '" + name + "'", names_and_ranges(table));
}

void halve(const VariationTable& table, Drawn& drawn) {
  for (std::size_t i = 0; i < drawn.values.size(); ++i) {
    const double mean = table.rules[i].parameter.mean;
    if (drawn.free[i]) drawn.values[i] = rounded(mean + 0.5 * (drawn.values[i] - mean));
  }
}

bool any_free(const Drawn& drawn) {
  return std::find(drawn.free.begin(), drawn.free.end(), true) != drawn.free.end();
}

struct VariedBones {
  AnatomyDescription description;
  GeneratedAnatomy grown;
  PlacedBones placed;  ///< before any joint is bent
};

Result<VariedBones> grow_varied(AnatomyDescription anatomy, const VariationTable& table,
                                const std::vector<double>& values, const GenerateOptions& options,
                                const std::string& file) {
  if (auto ok = vary(anatomy, table, values); !ok) return tl::unexpected(ok.error());
  auto grown = grow_bones(anatomy, options, file);
  if (!grown) return tl::unexpected(grown.error());
  PlacedBones placed(*grown, options);
  return VariedBones{std::move(anatomy), std::move(*grown), std::move(placed)};
}

/// Bends the joints as far as is set, unless two bones would meet.
Result<void> bend_unless_bones_meet(VariedBones& bones, const GenerateOptions& options,
                                    const std::string& file) {
  GeneratedAnatomy& grown = bones.grown;
  if (auto ok = bend_joints(bones.description, file, bones.placed, grown); !ok) return ok;
  const bool bent = std::any_of(grown.joints.begin(), grown.joints.end(),
                                [](const GeneratedJoint& joint) { return joint.at_deg != 0; });
  if (!bent) return {};
  const Overlap worst = deepest_overlap(grown, PlacedBones(grown, options), options);
  if (worst.depth <= kMostOverlap) return {};
  return fail(
      worst.bone + " would reach " + two_digits(worst.depth * 1000) + " mm into " + worst.other,
      file, "Bend the joint less, or choose values closer to the means");
}

Result<AnatomyDescription> load_description(const std::filesystem::path& file) {
  const auto text = read_file(file, 1 << 22);
  if (!text) return tl::unexpected(text.error());
  return parse_description(*text, file.string());
}

Result<std::vector<GeneratedFinding>> add_findings(const VariationRequest& request,
                                                   AnatomyDescription& anatomy) {
  if (request.findings.empty()) return std::vector<GeneratedFinding>{};
  const auto table = load_findings(request.findings_table);
  if (!table) return tl::unexpected(table.error());
  return apply_findings(*table, request.findings, anatomy);
}

Result<Drawn> choose(const VariationTable& table, const VariationRequest& request) {
  if (!request.side.empty() && request.side != "left" && request.side != "right")
    return fail("must be left or right, not '" + request.side + "'", "side");
  Drawn drawn = draw(table, request);
  for (const ParameterValue& set : request.set)
    if (auto ok = set_one(table, set, drawn); !ok) return tl::unexpected(ok.error());
  return drawn;
}

}  // namespace

Result<std::vector<VariationParameter>> list_variation(const std::filesystem::path& table) {
  const auto loaded = load_variation(table);
  if (!loaded) return tl::unexpected(loaded.error());
  std::vector<VariationParameter> parameters;
  for (const VariationRule& rule : loaded->rules) parameters.push_back(rule.parameter);
  return parameters;
}

Result<VariedAnatomy> generate_varied(const std::filesystem::path& description,
                                      const std::filesystem::path& table,
                                      const VariationRequest& request,
                                      const GenerateOptions& options) {
  const auto rules = load_variation(table);
  if (!rules) return tl::unexpected(rules.error());
  auto anatomy = load_description(description);
  if (!anatomy) return tl::unexpected(anatomy.error());
  auto findings = add_findings(request, *anatomy);
  if (!findings) return tl::unexpected(findings.error());
  auto drawn = choose(*rules, request);
  if (!drawn) return tl::unexpected(drawn.error());
  VariedAnatomy varied;
  Result<VariedBones> bones;
  for (;; ++varied.halvings, halve(*rules, *drawn)) {
    bones = grow_varied(*anatomy, *rules, drawn->values, options, description.string());
    if (!bones) return tl::unexpected(bones.error());
    const Overlap worst = deepest_overlap(bones->grown, bones->placed, options);
    if (worst.depth <= kMostOverlap) break;
    if (varied.halvings == kMostHalvings || !any_free(*drawn))
      return fail(
          worst.bone + " would reach " + two_digits(worst.depth * 1000) + " mm into " + worst.other,
          description.string(), "Choose values closer to the means");
  }
  const std::string file = description.string();
  if (auto ok = bend_unless_bones_meet(*bones, options, file); !ok)
    return tl::unexpected(ok.error());
  varied.anatomy = std::move(bones->grown);
  lay_on_skin(bones->description, varied.anatomy);
  if (!options.soft_parts)
    lay_on_bones(bones->description, varied.anatomy);
  else if (auto ok = grow_soft_parts(bones->description, options, file, varied.anatomy,
                                     std::move(bones->placed));
           !ok)
    return tl::unexpected(ok.error());
  if (auto ok = split_bones(bones->description, file, varied.anatomy); !ok)
    return tl::unexpected(ok.error());
  varied.anatomy.findings = std::move(*findings);
  for (std::size_t i = 0; i < rules->rules.size(); ++i)
    varied.values.emplace_back(rules->rules[i].parameter.name, drawn->values[i]);
  if (!request.side.empty() && request.side != varied.anatomy.side) mirror(varied.anatomy);
  return varied;
}

}  // namespace osteon
