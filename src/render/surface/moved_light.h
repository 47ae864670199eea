#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"

namespace osteon {

/// A soft surface that has given way, with the light that was worked out for it at rest: each
/// vertex takes its own along. `baked`: the shades that prepare_case gave of `rest`. Empty where
/// `moved` has not as many vertices as `rest`, or the shades are of another surface.
ShadedMesh moved_light(const TriMesh& rest, const std::vector<ShadedMesh::Shade>& baked,
                       const TriMesh& moved);

}  // namespace osteon
