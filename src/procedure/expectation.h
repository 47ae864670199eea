#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// Closed interval.
struct ExpectedRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// An expectation as its file states it. Keys of the maps are those of the report's JSON.
struct Expectation {
  std::optional<std::string> case_name;
  std::optional<std::string> state_hash;
  std::vector<std::string> touched;
  std::vector<std::string> untouched;
  bool all_others_untouched = false;
  std::vector<std::string> order;
  std::map<std::string, std::map<std::string, ExpectedRange>> bones;
  std::map<std::string, ExpectedRange> whole;    ///< "path_length_mm", "duration_s", ...
  std::map<std::string, ExpectedRange> tick_us;  ///< "p50", ...
};

/// Reads the JSON of check_expectation. Errors name the key.
Result<Expectation> parse_expectation(const std::string& json);

}  // namespace osteon
