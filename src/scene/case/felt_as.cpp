#include "osteon/scene/felt_as.h"

#include "osteon/hull/decompose.h"

namespace osteon {

Felt felt_as(const TriMesh& mesh, Felt chosen) {
  return chosen == Felt::kPieces && !can_decompose(mesh) ? Felt::kHull : chosen;
}

}  // namespace osteon
