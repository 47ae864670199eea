#pragma once

#include <cstdint>

namespace osteon {

/// A joint of a case that commands bend.
struct BendState {
  bool on = false;  ///< it was told to bend; before that its bones lie at rest
  double wanted_deg = 0, now_deg = 0;
  bool straight = false;     ///< it has been stretched out since it was last bent
  std::uint32_t cycles = 0;  ///< how often it was stretched out and bent again
};

}  // namespace osteon
