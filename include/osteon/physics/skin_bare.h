#pragma once

#include <cstdint>

namespace osteon {

/// What of the skin is felt no more.
enum class SkinBare : std::uint64_t {
  kNone = 0,
  kPortals = 1,  ///< patches of portals, from when on each of them has one
  kAll = 2
};

}  // namespace osteon
