#pragma once

#include <string>

#include "description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Grows every bone of a description that is in memory; `file` names it in errors.
Result<GeneratedAnatomy> grow_description(const AnatomyDescription& anatomy,
                                          const GenerateOptions& options, const std::string& file);

}  // namespace osteon
