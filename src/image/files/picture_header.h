#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// Pictures are at most so wide and high.
inline constexpr std::uint64_t kWidestPicture = 16384;

/// Fails, naming `where`, unless the bytes start as a PNG or TIFF picture of a sane size: those who
/// unpack it take room for what it says, however little of it there is.
Result<void> check_picture_header(std::string_view bytes, const std::string& where);

}  // namespace osteon
