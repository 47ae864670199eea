#pragma once

#include <string>

#include "describe/description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Parts bones as the description's splits say: the largest pieces of a bone become bones of their
/// own in its place, each under the fragment's name that it lies nearest to. Its cartilage is
/// parted likewise, one soft part a fragment that has any; what was attached to it holds on to the
/// nearest fragment. Fails where a bone has not come apart.
Result<void> split_bones(const AnatomyDescription& anatomy, const std::string& file,
                         GeneratedAnatomy& grown);

}  // namespace osteon
