#pragma once

#include "osteon/scene/case.h"

namespace osteon {

/// How a bone is really felt: an open mesh has no inside that could be cut into pieces, so it is
/// felt as its hull.
Felt felt_as(const TriMesh& mesh, Felt chosen);

}  // namespace osteon
