#pragma once

#include <array>
#include <span>
#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A mesh with smooth normals and no baked light. Edges sharper than 40 degrees stay sharp.
ShadedMesh plain_shaded(const TriMesh& mesh);

/// Hulls with one normal a facet.
ShadedMesh faceted(std::span<const Hull> hulls);
/// Ends of the edges between facets (not those inside a facet), two by two.
std::vector<std::array<float, 3>> facet_edges(std::span<const Hull> hulls);

/// Closed unit shapes for marks: cylinder and cone of radius 1 along z from 0 to 1, ball of radius
/// 1 about the origin.
TriMesh cylinder(int sides);
TriMesh cone(int sides);
TriMesh ball(int rings, int sides);

}  // namespace osteon
