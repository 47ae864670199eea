#pragma once

#include <filesystem>
#include <functional>

#include "osteon/base/result.h"

namespace osteon {

/// "cases/wrist/" names the same folder as "cases/wrist".
std::filesystem::path plain_folder(const std::filesystem::path& folder);

/// Fails when `out` exists and holds anything.
Result<void> refuse_existing(const std::filesystem::path& out);

/// Lets `write` fill a folder beside `out` and renames it at the end, so that a failure, a stop or
/// a full disk leaves nothing half-written under the name. `write` gets a name that is not in use.
Result<void> write_whole_folder(
    const std::filesystem::path& out,
    const std::function<Result<void>(const std::filesystem::path& part)>& write);

}  // namespace osteon
