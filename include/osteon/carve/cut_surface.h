#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Surface of all that was cut out of the bone and its cartilage, in Bone, for who follows rays
/// through it: their whole surface where a cut came near, and the carved one there turned round. A
/// ray has entered it once more than it has left it exactly where something is gone. Outside of
/// the blocks that cuts came near both surfaces are the same, and neither is there. Empty where
/// nothing was cut.
TriMesh cut_surface(const CarvedField& field);

/// Bones of a case that hold cuts, each with its place there.
using CutBones = std::vector<std::pair<std::uint32_t, CarvedField>>;

}  // namespace osteon
