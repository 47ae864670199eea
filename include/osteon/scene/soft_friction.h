#pragma once

namespace osteon {

/// Friction of instruments on soft parts: force across over force along the normal.
struct FrictionRatios {
  double resting = 0;  ///< until what is held slips
  double sliding = 0;  ///< not above `resting`
};

/// By kind of part, as the tissue table has it.
struct SoftFriction {
  FrictionRatios band, solid, skin{};
};

}  // namespace osteon
