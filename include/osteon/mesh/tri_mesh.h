#pragma once

#include <cstdint>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// Indexed triangle surface, metres, counter-clockwise seen from outside.
struct TriMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace osteon
