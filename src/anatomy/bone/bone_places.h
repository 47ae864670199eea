#pragma once

#include "describe/description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Lays landmarks that lie on a bone onto its surface as it is: a patient's shape moves the bone
/// and the place by different laws. For bones that grow without soft parts; what grows on them lays
/// the landmarks itself.
void lay_on_bones(const AnatomyDescription& anatomy, GeneratedAnatomy& grown);

}  // namespace osteon
