#pragma once

#include <cstdint>
#include <memory>

#include "osteon/base/result.h"
#include "osteon/collide/distance_field.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// A bone of a case with the case's cartilage on it, in Bone: parts of the kind "cartilage" that
/// move with this bone alone. Null where there is none, or the bone's mesh is not closed. A part
/// that is not closed is left out, and a warning says so.
std::shared_ptr<const CoveredSurface> covered_bone(const CaseDef& def, const BoneDef& bone);

/// Sets BoneDef::covered of the bones that are felt with their cartilage and do not have it yet.
void cover_bones(CaseDef& def);

/// What is felt of a bone that is felt as a field, as DistanceField::make has it: its mesh, or that
/// with its cartilage where BoneDef::covered is set.
Result<DistanceField> make_felt_field(const BoneDef& bone, const FieldOptions& options = {});
/// Its key in a FieldCache.
std::uint64_t field_key(const BoneDef& bone, const FieldOptions& options = {});

}  // namespace osteon
