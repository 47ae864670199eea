#pragma once

#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"
#include "surface/moved_light.h"

namespace osteon {

/// A soft surface that was cut, so that it has other vertices than at rest: those near the surface
/// at rest take its light over, the rest are the darker the deeper they lie under it. What was
/// found stays in `known` and goes along with the vertices until there is another cut. Empty where
/// the light is of another surface.
ShadedMesh cut_light(const TriMesh& rest, const RestLight& light, const TriMesh& cut,
                     CutLight& known);
/// Of a soft surface that was `rest`: by moved_light where it has its vertices, else by cut_light.
ShadedMesh shown_light(const TriMesh& rest, RestLight& light, const TriMesh& shown);

}  // namespace osteon
