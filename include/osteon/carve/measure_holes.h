#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A straight round hole in a surface, in the surface's frame.
struct Hole {
  Vec3 entry = Vec3::Zero();  ///< on the axis, in the middle of the first rim
  Vec3 exit = Vec3::Zero();   ///< in the middle of the other rim, or of where its wall ends
  Vec3 axis = Vec3::UnitZ();  ///< unit, from entry to exit
  double diameter_m = 0;
  double length_m = 0;   ///< from entry to exit
  bool through = false;  ///< neither end has a bottom, flat or pointed
  /// Openings of the wall beside the two ends: a cortex that the drill broke sideways, or a hole
  /// that it crossed.
  std::size_t side_openings = 0;
  double roundness_m = 0;  ///< root mean square distance of the wall from its cylinder
  /// Least way from the wall straight away from the axis to the next surface, further than a
  /// radius from both rims; none where the hole is too short to have such a place.
  std::optional<double> thinnest_wall_m;
  Vec3 thinnest_at = Vec3::Zero();  ///< on the wall
};

struct HoleOptions {
  double least_diameter_m = 0.5e-3;
  double largest_diameter_m = 30e-3;
  double roundness_m = 0.05e-3;     ///< a wall is no further than this from its cylinder
  double least_coverage_rad = 4.0;  ///< of the way round the axis that the wall must have
};

/// Finds the holes of a closed surface: cylinders are fitted to patches that bend about one
/// direction alone, hollow side out, and grown as far as the surface follows them. Knows nothing of
/// how a hole was made. In the order of their first triangles; walls on one axis are one hole.
std::vector<Hole> find_holes(const TriMesh& mesh, const HoleOptions& options = {});

/// Share of the bone in a ball that is gone, 0 to 1, by points on a lattice of 1/32 of its
/// diameter; none where the ball held no bone before.
std::optional<double> share_removed(const MeshDistance& before, const MeshDistance& after,
                                    const Vec3& center, double radius_m);

}  // namespace osteon
