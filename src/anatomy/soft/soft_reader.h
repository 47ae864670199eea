#pragma once

#include <functional>

#include "describe/toml_reader.h"
#include "osteon/base/result.h"
#include "soft/soft_description.h"

namespace osteon {

/// Index of a bone of the description by its name.
using FindBone = std::function<Result<std::size_t>(const std::string&)>;

/// Reads one [[soft]] table (docs/anatomy-description.md). Strict, as all of a description.
Result<SoftDescription> read_soft(TomlReader& in, const FindBone& find_bone);

}  // namespace osteon
