#pragma once

#include <string>

#include "bone/placed_bones.h"
#include "describe/description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Grows every soft part of the description over the bones of `grown`, which are finished, and lays
/// the landmarks that lie on a surface onto it (skin_places.h has those on the skin). Soft parts
/// that meet give way in the order cartilage, bands, volumes. `placed` saves making the surfaces of
/// those bones that stand where they grew.
Result<void> grow_soft_parts(const AnatomyDescription& anatomy, const GenerateOptions& options,
                             const std::string& file, GeneratedAnatomy& grown,
                             PlacedBones placed = {});

}  // namespace osteon
