#pragma once

#include <functional>

#include "osteon/scene/build_case.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {

/// Makes the pieces and the distance fields of a case's bones that the caches do not know, on all
/// cores, and puts them there. A field that cannot be made is left to build_case to tell.
/// `progress` is called on the calling thread with the share done; it may throw to stop.
void find_what_is_felt(const CaseDef& def, PieceCache& pieces, FieldCache& fields,
                       const std::function<void(double)>& progress);

/// Whether the caches have what is felt of this bone; always for one felt as its hull.
bool is_known(const BoneDef& bone, PieceCache& pieces, FieldCache& fields);

}  // namespace osteon
