#pragma once

#include <cstdint>
#include <functional>

#include "osteon/mesh/tet_mesh.h"

namespace osteon {

/// The point of a surface near `p`. `hint` is kept for each vertex between its calls, for what
/// finds the next point sooner; 0 at first.
using SurfaceProjection = std::function<Vec3(const Vec3& p, std::uint32_t& hint)>;

struct TetImproveOptions {
  double goal_deg = 22;  ///< elements whose dihedral angles all lie in [goal, 180 - goal] are left
  int most_passes = 25;
  /// A boundary face's middle may come to lie this much further from the surface, m.
  double slack_m = 0;
};

struct TetImproveReport {
  int passes = 0;
  std::size_t vertex_moves = 0;
  std::size_t edges_removed = 0;
  std::size_t faces_removed = 0;
};

/// Makes the worst elements of a mesh of upright elements better: vertices move to where the worst
/// of their elements is best, by pattern search (boundary vertices along the surface only, where
/// `project` puts them); edges and faces whose removal makes the worst element around them better
/// are removed (Shewchuk, "Two discrete optimization algorithms for the topological improvement of
/// tetrahedral meshes", 2002). An element's worth is the least sine of its dihedral angles, so the
/// flat and the needle both count. The worst element never gets worse and none is inverted. The
/// same input gives the same bytes.
TetImproveReport improve(TetMesh& mesh, const SurfaceProjection& project,
                         const TetImproveOptions& options = {});

}  // namespace osteon
