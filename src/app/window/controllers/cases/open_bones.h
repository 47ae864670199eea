#pragma once

#include <string>
#include <vector>

#include "osteon/scene/case.h"

namespace osteon {

/// Of each bone, whether its surface is open: such a bone has no inside that could be cut or felt.
std::vector<bool> open_bones(const Case& the_case);

/// What to tell the user of a case's open bones; empty: all are closed.
std::string open_bones_notice(const Case& the_case);

}  // namespace osteon
