#include "osteon/tissue/supports.h"

namespace osteon {

Ramp smooth_ramp(double time_s, double over_s) {
  if (!(time_s < over_s)) return {1, 0, 0};
  const double s = time_s / over_s;
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 + s * (s - 2)) / over_s,
          60 * s * (1 + s * (2 * s - 3)) / (over_s * over_s)};
}

}  // namespace osteon
