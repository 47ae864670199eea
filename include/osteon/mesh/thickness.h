#pragma once

#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

/// How thick a closed, outward surface is, m, at the middles of at most about `samples` triangles
/// taken evenly: the diameter of the largest ball inside that touches there, found by shrinking
/// (Ma, Bae and Choi, The Visual Computer 28, 2012). A ball held by the surface right beside the
/// touching point (seen from its centre within 60 degrees) is not shrunk: that is roughness, not
/// another side. What is thicker than `largest_m` counts as that thick.
struct ThicknessSample {
  Vec3 point = Vec3::Zero();
  double thickness_m = 0;
  double area_m2 = 0;  ///< that the sample stands for
};
std::vector<ThicknessSample> thickness_samples(const MeshDistance& surface, std::size_t samples,
                                               double largest_m);

/// The thickness which `share` of the area falls short of, m; 0 of no sample.
double thickness_quantile(std::vector<ThicknessSample> samples, double share);

}  // namespace osteon
