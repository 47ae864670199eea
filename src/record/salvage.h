#pragma once

#include <filesystem>

#include "osteon/base/result.h"

namespace osteon {

/// Whether a database file is shorter than its own header says, with no log beside it that could
/// hold the rest: a copy that was broken off, or a disk that lost the end. False for other files.
bool is_cut_short(const std::filesystem::path& file);

/// Makes the recording `into` from what can still be read of `cut`, a recording that was cut short:
/// of each table the rows from its first to the last before something is missing. It is not marked
/// as complete. `cut` is changed: work on a copy. Fails where not even the header can be read.
Result<void> salvage(const std::filesystem::path& cut, const std::filesystem::path& into);

}  // namespace osteon
