#pragma once

#include <string>

#include "osteon/scene/case.h"
#include "osteon/scene/path.h"

namespace osteon {

/// The path that the demonstration plays on a case: the one that Osteon ships for it, else a survey
/// made now.
ProbePath demo_path(const Case& the_case, const std::string& case_source);

}  // namespace osteon
