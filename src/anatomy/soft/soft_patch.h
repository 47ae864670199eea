#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A place on a surface that a layer may cover.
struct CoveredVertex {
  Vec3 p = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  double inside = 0;  ///< negative where the layer does not reach; its rim is where this is 0
  double height = 0;  ///< of the layer, metres
};

struct CoveredPatch {
  std::vector<CoveredVertex> vertices;
  std::vector<Triangle> triangles;
};

/// The part of the patch where `inside` is positive, its triangles cut along the rim; vertices
/// close to it are moved onto it. Those of the whole patch come first, in their order. Heights are
/// needed up to one triangle beyond the rim. Pieces of less than `least_area_m2` are left out.
CoveredPatch cut_patch(const CoveredPatch& whole, double least_area_m2);

/// Closed shell between the patch and the same raised along its normals by the heights, which must
/// be positive. Where the patch touches itself at a point, the shell is parted there.
TriMesh raise_patch(const CoveredPatch& patch);

}  // namespace osteon
