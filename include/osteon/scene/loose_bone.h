#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// A piece of bone that was cut off and lies loose, for who draws it.
struct LooseBone {
  std::uint64_t shape = 0;  ///< hash of its shape
  std::uint32_t bone = 0;   ///< of the case, that it was part of
  Pose X_WB;                ///< of that bone's frame, as the piece has carried it along
};

/// The most pieces that lie loose at once.
inline constexpr std::size_t kMaxLooseBones = 16;

struct LooseBones {
  std::uint32_t count = 0;
  std::array<LooseBone, kMaxLooseBones> bones{};
};

}  // namespace osteon
