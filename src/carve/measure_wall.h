#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon::measure {

inline constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

/// A surface's triangles as a walk over it needs them.
struct Faces {
  explicit Faces(const TriMesh& mesh);

  const TriMesh& mesh;
  std::vector<Vec3> normals;  ///< unit; zero of a triangle without area
  std::vector<double> areas;
  std::vector<std::array<std::uint32_t, 3>> across;  ///< the triangle over edge k, from corner k on
};

/// A cylinder without ends.
struct Cylinder {
  Vec3 point = Vec3::Zero();  ///< on the axis
  Vec3 axis = Vec3::UnitZ();
  double radius = 0;
  double roundness = 0;  ///< root mean square distance of the triangles' corners from it

  Vec3 radial(const Vec3& p) const {
    const Vec3 r = p - point;
    return r - axis * axis.dot(r);
  }
};

/// Cylinder of a patch by least squares: the axis is the direction in which its normals spread
/// least, the circle that of its corners (Coope 1993). None where the patch is flat or its normals
/// spread every way.
std::optional<Cylinder> fit_cylinder(const Faces& faces, const std::vector<std::uint32_t>& patch);

/// All triangles about `seed` that follow the cylinder within `off_m` and face its axis.
std::vector<std::uint32_t> grow_wall(const Faces& faces, std::uint32_t seed, const Cylinder& fit,
                                     double off_m);

/// A closed way along the edges of a wall, and what lies beyond.
struct WallRim {
  double height = 0;  ///< along the axis, the mean over the way round it
  double round = 0;   ///< rad about the axis that the way turns, signed: 0 or about 2 pi
  double lowest = 0, highest = 0;
  bool bottom = false;  ///< beyond lies a flat end across the axis
};
std::vector<WallRim> rims_of(const Faces& faces, const std::vector<std::uint32_t>& wall,
                             const Cylinder& fit);

/// How much of the way round the axis the wall has, rad.
double coverage(const Faces& faces, const std::vector<std::uint32_t>& wall, const Cylinder& fit);

}  // namespace osteon::measure
