#pragma once

#include <string>
#include <vector>

#include "osteon/device/closed_loop.h"

namespace osteon {

/// Where one hand's loop settles: walls against delays.
struct StabilityMap {
  std::string title;
  std::vector<double> delays_s;       ///< of the columns, rising
  std::vector<double> walls_n_per_m;  ///< of the rows, rising
  std::vector<WallOutcome> outcomes;  ///< row by row
  double damping_n_s_per_m = 0;       ///< of the hand, for Colgate's bound
  double tick_s = 0.001;

  int swinging() const;
};

/// What stands between simulation and hand.
enum class LoopGuard { kNone, kObserverAndDamping, kAll };

/// Columns: 0 to 3 ms of delay. Rows: walls of 0.5 to 10 N/mm, evenly by their logarithm.
StabilityMap map_stability(const HandParams& hand, LoopGuard guard, int columns, int rows);

/// A picture (SVG) of maps, side by side in rows of `across`.
std::string to_svg(const std::vector<StabilityMap>& maps, std::size_t across);

}  // namespace osteon
