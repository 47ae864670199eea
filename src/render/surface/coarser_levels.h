#pragma once

#include <vector>

#include "osteon/render/prepare.h"

namespace osteon {

/// Levels whose surface lies within 12.5, 25, 50, 100 and 200 um of the full one, by edge collapse
/// with quadric errors (Garland and Heckbert 1997; meshoptimizer). Shades count as well: where they
/// vary within a level's triangles in a way that those cannot follow, vertices are kept. A level
/// that saves less than a quarter of the one before is left out.
std::vector<ShadedMesh::Level> coarser_levels(const ShadedMesh& mesh);

}  // namespace osteon
