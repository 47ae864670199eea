#pragma once

#include <string>

namespace osteon {

struct LoadProgress {
  std::string what;  ///< "Generating the bones"
  double fraction = 0;
  double seconds_left = -1;  ///< estimated from the pace so far; -1: too early to tell
};

/// Time left when `fraction` of some work took `elapsed_s`: -1 within the first half second and the
/// first 5 percent, which tell nothing yet.
double seconds_left(double elapsed_s, double fraction);

}  // namespace osteon
