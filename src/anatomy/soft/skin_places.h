#pragma once

#include "describe/description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Lays the landmarks that lie on the skin onto it and says which way leads into the body there.
/// It looks at the skin's field, not at its surface, so that they lie where they do whether that is
/// grown or not. `grown` holds the landmarks as the description has them.
void lay_on_skin(const AnatomyDescription& anatomy, GeneratedAnatomy& grown);

}  // namespace osteon
