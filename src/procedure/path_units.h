#pragma once

namespace osteon {

/// What measures of a path have in common: lengths in mm, of a path resampled at this rate.
constexpr double kMmPerM = 1000;
constexpr double kPathRateHz = 100;

}  // namespace osteon
