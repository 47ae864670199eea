#pragma once

#include <functional>

#include "osteon/scene/build_case.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {

/// Cuts the bones of a case whose pieces the cache does not know, on all cores, and puts them
/// there. `progress` is called on the calling thread with the share done; it may throw to stop.
void find_pieces(const CaseDef& def, PieceCache& cache,
                 const std::function<void(double)>& progress);

}  // namespace osteon
