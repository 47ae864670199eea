#pragma once

#include "describe/description.h"
#include "describe/toml_reader.h"

namespace osteon {

/// Reads one [[joint]] of a description whose bones and soft parts are known; the caller finishes
/// the reader, and has the message of what is wrong there.
RollingJoint read_joint(TomlReader& in, const AnatomyDescription& anatomy);

}  // namespace osteon
