#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct ExtentBox {
  Vec3 center = Vec3::Zero();
  Vec3 half_m = Vec3::Zero();  ///< half its sides
};

/// Boxes that hold all finite vertices of a mesh, along the axes of its own frame: at most eight
/// along each side of the box about all. That one, and more so a ball, would reach far beyond a
/// long bone that lies askew.
std::vector<ExtentBox> extent_boxes(const TriMesh& mesh);

}  // namespace osteon
