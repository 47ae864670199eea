#pragma once

namespace osteon {

/// Share of a bundle's circle that its strands fill (own default).
inline constexpr double kBundleFilled = 0.9;

/// Thread, loop and button as they are drawn at the bench and in the knee, m.
inline constexpr double kThreadRadius_m = 0.0005, kLoopRadius_m = 0.0012, kButtonRadius_m = 0.002;

}  // namespace osteon
