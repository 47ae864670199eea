#pragma once

#include "osteon/render/prepare.h"
#include "surface/surface.h"

namespace osteon {

/// Gives the sides of sharp edges (over 60 degrees: the rim of a hole) normals of their own, so
/// that light does not run over from one to the other. `mesh` is `surface` point by point; points
/// on such edges are added to it. One without sharp edges stays as it is.
void split_creases(const Surface& surface, ShadedMesh& mesh);

}  // namespace osteon
