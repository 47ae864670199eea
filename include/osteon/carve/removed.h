#pragma once

#include "osteon/carve/carved_field.h"

namespace osteon {

/// What all cuts together have removed, m^3 by tissue: the volume where bone and cut overlap, both
/// linear between nodes. Looks at every block that holds a cut.
ByTissue removed_volume(const CarvedField& field);

double total(const ByTissue& by_tissue);

}  // namespace osteon
