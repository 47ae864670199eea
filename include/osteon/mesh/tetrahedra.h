#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/tet_improve.h"
#include "osteon/mesh/tet_mesh.h"

namespace osteon {

struct TetrahedraOptions {
  /// Edge of the lattice's cubes, m. 0: from the thinnest part, made smaller until the volume fits.
  double cell_m = 0;
  double goal_deg = 22;         ///< see TetImproveOptions
  double volume_share = 0.008;  ///< of the surface's volume that a chosen cell may miss it by
  std::size_t most_tets = 4'000'000;
};

/// What came out, measured on the mesh and on the surface that it fills.
struct TetrahedraReport {
  double cell_m = 0;
  double thickness_m = 0;  ///< of the surface: 95 % of its area is thicker (half its size at most)
  TetQuality before;       ///< as the lattice gave it
  TetQuality after;        ///< once improved
  TetImproveReport improvement;
  double surface_volume_m3 = 0;
  double volume_before_m3 = 0;
  double volume_m3 = 0;
  double vertex_distance_m = 0;   ///< the furthest boundary vertex from the surface
  double face_distance_m = 0;     ///< the furthest middle of a boundary face from the surface
  double surface_distance_m = 0;  ///< the furthest vertex of the surface from the mesh's boundary
  Topology boundary;              ///< of the mesh's surface
  std::vector<std::string> warnings;

  double volume_error() const { return volume_m3 / surface_volume_m3 - 1; }
};

struct Tetrahedra {
  TetMesh mesh;
  TetrahedraReport report;
};

/// Fills a closed, outward surface with tetrahedra of good shape: isosurface stuffing (stuffing.h)
/// of its exact signed distance, then improvement (tet_improve.h) with the boundary's vertices held
/// on the surface.
///
/// Fails on a surface that is empty, open, not finite, faces inwards or crosses itself, on one
/// thinner than a cell everywhere, and on more than `most_tets` elements. Warns when a cell is too
/// coarse for the thinnest part, when the volume misses by 1 % or when an angle lies below 15
/// degrees. The same input gives the same bytes.
Result<Tetrahedra> make_tetrahedra(const TriMesh& surface, const TetrahedraOptions& options = {});

}  // namespace osteon
