#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "osteon/anatomy/variation.h"
#include "osteon/base/types.h"

namespace osteon {

/// What a step acts on. "*" stands for every bone, or every landmark. Where `parts` names any, of
/// the bones only these parts.
struct StepTargets {
  std::vector<std::string> bones, landmarks, parts;
};

/// Bends shafts: what lies at x_W of `full_x` or less turns about the pivot, what lies at `none_x`
/// or more stays, and the turn grows smoothly in between.
struct TurnStep {
  StepTargets targets;
  Vec3 degrees_per_unit = Vec3::Zero();
  Vec3 pivot_W = Vec3::Zero();
  double full_x = 0, none_x = 0;
};

struct ShiftStep {
  StepTargets targets;
  Vec3 metres_per_unit = Vec3::Zero();
};

/// Scales about a fixed point by 1 + share.
struct ScaleStep {
  StepTargets targets;
  Vec3 center_W = Vec3::Zero();
  double share_per_unit = 0;
};

struct VariationRule {
  VariationParameter parameter;
  std::vector<TurnStep> turns;
  std::vector<ShiftStep> shifts;
  std::vector<ScaleStep> scales;
  std::string joint;  ///< the joint that the value bends, in degrees; empty: none
};

struct VariationTable {
  std::string file;
  std::vector<VariationRule> rules;
  std::size_t overall_size = 0;  ///< index of the rule that scales all; applied last
};

Result<VariationTable> parse_variation(std::string_view text, const std::string& file);
Result<VariationTable> load_variation(const std::filesystem::path& file);

}  // namespace osteon
