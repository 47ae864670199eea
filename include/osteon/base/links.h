#pragma once

#include <filesystem>

namespace osteon {

/// Where symbolic links lead from `path`, whether something is there or not; `path` itself when it
/// is no link. Of links in a circle some link. Links of open files (/dev/stdout leads to
/// /proc/self/fd/1) are not followed further: what they name may have no path.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Number of the open file that a path such as /proc/self/fd/1 names; else -1.
int open_descriptor(const std::filesystem::path& path);

}  // namespace osteon
