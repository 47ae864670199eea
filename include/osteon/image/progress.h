#pragma once

#include <functional>

#include "osteon/base/result.h"

namespace osteon {

/// Long work tells where it is (`share` of this part of it, 0 to 1) and stops when the answer is
/// false. May be empty.
using Progress = std::function<bool(const char* what, double share)>;

inline bool goes_on(const Progress& progress, const char* what, double share) {
  return !progress || progress(what, share);
}

/// What a function that was told to stop returns.
inline tl::unexpected<Error> stopped() { return fail("stopped on request; nothing was written"); }

}  // namespace osteon
