#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "osteon/anatomy/findings.h"
#include "osteon/anatomy/generate.h"
#include "osteon/base/result.h"

namespace osteon {

/// One way in which people differ. The unit is the end of the name: _deg, _mm or _percent.
struct VariationParameter {
  std::string name;
  double mean = 0, sd = 0, min = 0, max = 0;
  double built_in = 0;  ///< what the description has when nothing is varied
  std::string source;   ///< where mean and deviation come from
  std::string meaning;
};

using ParameterValue = std::pair<std::string, double>;

struct VariationRequest {
  /// Draws every parameter from its normal distribution, clipped to its range and rounded to
  /// 0.01; none: a parameter that is not set keeps what the description has.
  std::optional<std::uint64_t> seed;
  std::vector<ParameterValue> set;  ///< overrides what is drawn
  std::string side;                 ///< "left", "right", or empty: the description's own
  /// What is wrong with the patient, from `findings_table` (assets/anatomy/*_findings.toml).
  std::vector<FindingChoice> findings = {};
  std::filesystem::path findings_table = {};
};

struct VariedAnatomy {
  GeneratedAnatomy anatomy;
  std::vector<ParameterValue> values;  ///< every parameter as it was used, in the table's order
  /// How often what was drawn had to be moved half the way to the mean since bones met.
  int halvings = 0;
};

/// The parameters of a table (assets/anatomy/*_variation.toml; docs/anatomy-description.md).
Result<std::vector<VariationParameter>> list_variation(const std::filesystem::path& table);

/// Grows a description as varied by a table, with the findings that are asked for: parts that a
/// finding does not touch have the same bytes as without it. No two bones of the result overlap by
/// more than kMostOverlap: where they would, drawn values move half the way to their means, a few
/// times over; where that does not help (or all was set), the error names the bones. The same
/// request gives the same bytes on every compiler. A name that is not in the table, or a value out
/// of its range, is an error that lists names and ranges; so is a finding or grade that the table
/// of findings does not have.
Result<VariedAnatomy> generate_varied(const std::filesystem::path& description,
                                      const std::filesystem::path& table,
                                      const VariationRequest& request,
                                      const GenerateOptions& options = {});

inline constexpr double kMostOverlap = 0.0001;  ///< metres

}  // namespace osteon
