#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// Whole content of a file; refuses one larger than `limit_bytes`.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t limit_bytes = 1ull << 30);

/// Replaces `path` in one step (temporary file, flushed, renamed), so that a full disk or a kill
/// leaves the old content whole. A link stays, a device or pipe too: what is behind it is written.
Result<void> write_file_atomic(const std::filesystem::path& path, std::string_view content);

/// Folder of the files that Osteon ships (`assets`, `shaders`): $OSTEON_DATA, else beside the
/// executable, else the source tree of this build.
Result<std::filesystem::path> find_data_dir();

}  // namespace osteon
