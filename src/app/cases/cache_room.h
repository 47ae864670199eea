#pragma once

#include <cstdint>
#include <filesystem>

namespace osteon {

/// What pieces and fields of generated patients may take in the user's cache, bytes. They are made
/// again when a patient is opened anew.
inline constexpr std::uintmax_t kMostCacheBytes = std::uintmax_t{2} << 30;

/// Says that a file of the cache was used now. One that is not there is not made.
void note_use(const std::filesystem::path& file);

/// Removes files of pieces and fields (`pieces-*.bin`, `fields-*.bin`) from the folder, the longest
/// unused first, until those left take `most_bytes` or less. Never removes one that was used as
/// lately as `newest`, nor anything else in the folder. What cannot be removed stays.
void keep_cache_room(const std::filesystem::path& folder, const std::filesystem::path& newest,
                     std::uintmax_t most_bytes = kMostCacheBytes);

}  // namespace osteon
