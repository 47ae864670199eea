#pragma once

#include <filesystem>

namespace osteon {

/// Where the built-in descriptions lie.
inline const std::filesystem::path kAnatomyAssets =
    std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy";

}  // namespace osteon
