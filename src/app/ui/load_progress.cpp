#include "ui/load_progress.h"

namespace osteon {

double seconds_left(double elapsed_s, double fraction) {
  if (!(elapsed_s >= 0.5) || !(fraction >= 0.05) || fraction > 1) return -1;
  return elapsed_s * (1 - fraction) / fraction;
}

}  // namespace osteon
