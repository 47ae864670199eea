#pragma once

#include <functional>
#include <vector>

#include "surface/surface.h"

namespace osteon {

/// A surface and where it rests.
struct PlacedSurface {
  Surface surface;
  Pose X_WB;
};

/// How much of the sky each vertex of each surface sees, 0..1: cosine-weighted share of directions
/// that reach `reach_m` without meeting a surface; what is met further away hides less. All
/// surfaces hide each other, and `others` hide them too. More than about `rays` are not cast: where
/// that is too few, some vertices are sampled and the rest filled in. `progress` as in
/// prepare_case.
std::vector<std::vector<float>> sky_openness(const std::vector<PlacedSurface>& surfaces,
                                             const std::vector<PlacedSurface>& others,
                                             double reach_m, std::size_t rays,
                                             const std::function<bool(double)>& progress);

/// Rays that the bones of a case may cost.
inline constexpr std::size_t kRayBudget = 2'500'000;

}  // namespace osteon
