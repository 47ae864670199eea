#pragma once

#include <string>
#include <vector>

#include "osteon/scene/event.h"

namespace osteon {

/// Ten times a second while a hand looks through a scope in a joint filled with water, of that
/// hand: {1: nothing can be seen, 0: it can; turbidity, 0 to 1; pressure of the water, mmHg}.
inline constexpr EventKind kWaterLooked{310};

/// Why nothing can be seen.
enum class SightLost : std::uint8_t {
  kPressure,  ///< too low to hold the joint open
  kBlood,
  kDebris
};
const char* to_text(SightLost cause);

/// How long a scope showed nothing.
struct ObscuredSight {
  struct Stretch {
    double from_s = 0, to_s = 0;
    SightLost cause = SightLost::kPressure;  ///< as it began
  };
  double scope_s = 0;     ///< a hand looked through a scope
  double obscured_s = 0;  ///< and nothing could be seen
  std::vector<Stretch> stretches;

  /// Of the time with a scope, 0 to 100.
  double percent() const { return scope_s > 0 ? 100 * obscured_s / scope_s : 0; }
};

/// The metric of that name: percent().
inline constexpr const char* kObscuredPercent = "obscured_percent";

}  // namespace osteon
