#include "osteon/carve/rbf_force.h"

#include <cmath>

namespace osteon {

double naive_drill_force(NaiveDrillState& state, const GuidedTunnel& tunnel, double drill_m) {
  if (!(drill_m > state.tunnel_m) || !(drill_m < tunnel.length_m)) return 0;
  state.tunnel_m = drill_m;
  return tunnel.force_n;
}

double rbf_drill_force(RbfDrillState& state, const GuidedTunnel& tunnel, double drill_m) {
  const double h = tunnel.spacing_m();
  double sum = 0;
  for (int i = 2; i <= tunnel.vertices - 1; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << (i - 1);
    const double c = (i - 1) * h;
    if (drill_m - c > h) state.inactive |= bit;
    const double r = std::abs(drill_m - c);
    if ((state.inactive & bit) == 0 && r < h) sum += (h - r) / h * tunnel.force_n;
  }
  return sum;
}

}  // namespace osteon
