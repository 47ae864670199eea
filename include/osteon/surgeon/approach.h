#pragma once

#include <cstdint>
#include <optional>

#include "osteon/scene/case.h"

namespace osteon {

/// A straight free way from outside onto a bone.
struct Approach {
  Vec3 p_W = Vec3::Zero();   ///< place on the bone
  Vec3 n_W = Vec3::UnitZ();  ///< unit, from there to the outside
  double clearance_m = 0;    ///< to other bones, the least along the way
  double free_m = 0;         ///< how far the tool may slide along `along_W` and stay on the bone
  Vec3 along_W = Vec3::UnitX();
};

/// The ball around the case within which ways are looked at.
struct Surroundings {
  Vec3 center_W = Vec3::Zero();
  double radius_m = 0;
};
Surroundings surroundings_of(const Case& the_case);

/// Distance of a point in World to a bone at rest: exact inside and over a facet, never more than
/// the true one elsewhere (the largest distance to a plane of a convex piece).
double gap_to(const Bone& bone, const Vec3& p_W);

/// The clearest of a fixed number of random places whose way along the surface's normal is free for
/// a tip of that radius; none: the bone cannot be reached so. A function of its arguments.
std::optional<Approach> find_approach(const Case& the_case, std::uint32_t bone, double tip_radius_m,
                                      std::uint64_t seed);

}  // namespace osteon
