#pragma once

#include <span>

namespace osteon {

/// The gain of a scope's camera for the light that it sees (linear, one value a place): brings the
/// mean of the logarithms to kMeanLight, unless the brightest of tissue would turn white then:
/// all but kMaySpark of the places stay at or below kMostLight. What is not a finite number does
/// not count. 1 where nothing counts.
double exposure_gain(std::span<const double> light);

inline constexpr double kMeanLight = 0.30, kMostLight = 1.6, kMaySpark = 0.02;

}  // namespace osteon
