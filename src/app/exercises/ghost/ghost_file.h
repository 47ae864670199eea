#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "exercises/ghost/ghost_track.h"
#include "osteon/base/result.h"

namespace osteon {

/// A track as bytes, poses to the bit, with a checksum. `key`: what it was made from and by.
std::string to_bytes(const GhostTrack& track, std::uint64_t key);
/// Fails on what is not such bytes, on damaged ones, and on those of another key.
Result<GhostTrack> ghost_from_bytes(std::string_view bytes, std::uint64_t key);

/// Of a recording and the program that runs now, by their files' sizes and times: another build may
/// judge the same recording in another way. 0: one of them is not there.
std::uint64_t ghost_key(const std::filesystem::path& recording);

}  // namespace osteon
