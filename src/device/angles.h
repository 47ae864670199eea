#pragma once

#include <numbers>

namespace osteon {

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kRadPerDeg = std::numbers::pi / 180;

}  // namespace osteon
