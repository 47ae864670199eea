#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Corners a, b, c, d of a tetrahedron: a, b, c run counter-clockwise seen from d, so that
/// (b - a) x (c - a) . (d - a) is positive.
using Tetrahedron = std::array<std::uint32_t, 4>;

/// Indexed tetrahedra, metres. An element of positive signed volume is upright; one of zero or
/// negative volume is inverted.
struct TetMesh {
  std::vector<Vec3> vertices;
  std::vector<Tetrahedron> tets;
};

/// The faces of a tetrahedron by its corners, each counter-clockwise seen from outside; face k lies
/// opposite corner k.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kTetFaces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// m^3; positive when upright.
double signed_volume(const std::array<Vec3, 4>& corners);
/// The angles between the faces, rad in [0, pi], at the edges 01, 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Vec3, 4>& corners);
std::array<Vec3, 4> corners_of(const TetMesh& mesh, const Tetrahedron& tet);

/// Sum of the elements' signed volumes, m^3.
double volume(const TetMesh& mesh);

/// The surface of a tetrahedral mesh.
struct TetBoundary {
  TriMesh surface;                       ///< outward; only the vertices that lie on it
  std::vector<std::uint32_t> vertex_of;  ///< of each surface vertex: its index in the mesh
  std::vector<std::uint32_t> tet_of;     ///< of each triangle: the element behind it
};
/// Every face that belongs to one element alone, in the order of the elements.
TetBoundary boundary(const TetMesh& mesh);

inline constexpr std::size_t kDihedralBins = 18;  ///< of ten degrees each

/// Shape of a mesh's elements. Angles in radians; of no element: 0.
struct TetQuality {
  double min_dihedral_rad = 0;
  double max_dihedral_rad = 0;
  double mean_smallest_rad = 0;  ///< mean over the elements of each one's smallest angle
  std::size_t inverted = 0;      ///< elements of zero or negative volume
  /// How many dihedral angles fall into each ten degrees from 0 to 180; six an element.
  std::array<std::size_t, kDihedralBins> histogram{};
};
TetQuality quality(const TetMesh& mesh);

}  // namespace osteon
