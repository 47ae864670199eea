#pragma once

#include <array>
#include <cstdint>

#include "osteon/scene/event.h"

namespace osteon {

/// A structure that the tip of an instrument is in.
struct Inside {
  SubjectKind kind = SubjectKind::kNothing;  ///< kBone or kSoftPart; kNothing: this place is free
  std::uint32_t subject = 0;
  std::uint64_t first_step = 0;  ///< of physics, in which it was found there
  std::uint64_t last_step = 0;   ///< in which it was last found there
  double deepest_m = 0;          ///< under the structure's surface
  bool operator==(const Inside&) const = default;
};
/// A tip in fat is in the skin too; in more structures at once it is nowhere.
inline constexpr std::size_t kMostInside = 6;
/// Of one hand, in the order of their places.
using InsideList = std::array<Inside, kMostInside>;

}  // namespace osteon
