#pragma once

#include <cmath>
#include <vector>

namespace osteon {

/// Of two values or more; the SD with n - 1.
struct SampleSpread {
  double mean = 0, sd = 0;
};

inline SampleSpread spread_of(const std::vector<double>& values) {
  SampleSpread spread;
  for (const double v : values) spread.mean += v / static_cast<double>(values.size());
  double squares = 0;
  for (const double v : values) squares += (v - spread.mean) * (v - spread.mean);
  spread.sd = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return spread;
}

}  // namespace osteon
