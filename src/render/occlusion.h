#pragma once

#include <functional>
#include <vector>

#include "surface.h"

namespace osteon {

/// A surface and where it rests.
struct PlacedSurface {
  Surface surface;
  Pose X_WB;
};

/// How much of the sky each vertex of each surface sees, 0..1: cosine-weighted share of directions
/// that reach `reach_m` without meeting a surface; what is met further away hides less. All
/// surfaces hide each other. `progress` as in prepare_case.
std::vector<std::vector<float>> sky_openness(const std::vector<PlacedSurface>& surfaces,
                                             double reach_m,
                                             const std::function<bool(double)>& progress);

}  // namespace osteon
