#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// Opens the window with the briefing of an exercise and returns when it is closed; attempts are
/// kept under `learner`. Fails where this program was built without its windows.
Result<void> exercise_in_window(const std::string& scenario, std::optional<std::uint64_t> seed,
                                const std::string& learner);

}  // namespace osteon
