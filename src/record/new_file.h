#pragma once

#include <filesystem>

#include "osteon/base/result.h"

namespace osteon {

/// Where a new recording is made until it has its header: beside `file`.
std::filesystem::path unfinished_name(const std::filesystem::path& file);

/// Gives the file at `unfinished_name(file)` its name in one step, so that under `file` there is
/// never a recording without a header, at whatever moment the program is killed. Fails when `file`
/// exists.
Result<void> name_new_file(const std::filesystem::path& file);

}  // namespace osteon
