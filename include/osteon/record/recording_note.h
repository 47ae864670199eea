#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// Text kept in a finished recording beside what was recorded, such as the exercise that was
/// played. Replaying looks at none of it. Replaces a note of the same name. Fails on a file that is
/// no recording, on a name that is empty or longer than 60 bytes, on more than 4 MiB of text, and
/// when the file cannot be written.
Result<void> write_note(const std::filesystem::path& recording, std::string_view name,
                        std::string_view text);
/// None: the recording has no such note.
Result<std::optional<std::string>> read_note(const std::filesystem::path& recording,
                                             std::string_view name);

}  // namespace osteon
