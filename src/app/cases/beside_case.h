#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// Lays what belongs to the same patient's operation beside him: `graft_bench`, the bench on which
/// a graft is made of his tendons. A patient who was drawn has the tendons that his seed draws. ""
/// lays nothing there. Fails on another name, and where a bone or a landmark has a name that the
/// case has already.
Result<void> lay_beside(const std::string& anatomy, CaseDef& def);

}  // namespace osteon
