#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// Of a piece that was part of a bone, not of a soft part.
inline constexpr std::uint32_t kNoSoftPart = 0xffffffffu;

/// A piece of bone, or of a soft part on it, that was cut off and lies loose, for who draws it.
struct LooseBone {
  std::uint64_t shape = 0;           ///< hash of its shape
  std::uint32_t bone = 0;            ///< of the case, that it was part of, or lay on
  Pose X_WB;                         ///< of that bone's frame, as the piece has carried it along
  std::uint32_t soft = kNoSoftPart;  ///< of the case, that it was part of
};

/// The most pieces that lie loose at once: of bones, of soft parts, of both.
inline constexpr std::size_t kMaxLooseBones = 16, kMaxLooseSofts = 8;
inline constexpr std::size_t kMaxLoose = kMaxLooseBones + kMaxLooseSofts;

struct LooseBones {
  std::uint32_t count = 0;
  std::array<LooseBone, kMaxLoose> bones{};
};

}  // namespace osteon
