#pragma once

#include <span>
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// Loads the first of `candidates` (names or paths) that the system can load. It stays loaded until
/// the program ends: vendors' libraries start threads of their own that outlive any order of
/// unloading. The error tells what the system said of each that is there and did not load.
Result<void*> load_shared_library(std::span<const std::string> candidates);

/// Address of a function in it; null when it has none of that name.
void* find_symbol(void* library, const char* name);

}  // namespace osteon
