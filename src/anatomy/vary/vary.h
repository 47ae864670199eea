#pragma once

#include <vector>

#include "describe/description.h"
#include "vary/variation_table.h"

namespace osteon {

/// Changes a description as the table says; `values` holds one value a rule. Fails where a step
/// names a bone or a landmark that is not there.
Result<void> vary(AnatomyDescription& anatomy, const VariationTable& table,
                  const std::vector<double>& values);

/// The other hand: mirrored at the plane y_W = 0.
void mirror(GeneratedAnatomy& anatomy);

}  // namespace osteon
