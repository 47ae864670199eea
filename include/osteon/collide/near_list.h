#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// The planes (vertices) of a body that a point (a direction) found highest, as a query leaves them
/// for the next one: while the point has not moved far, no other needs a look. Whether they still
/// serve is checked each time, so that a list of any age, or another body's, changes no answer.
struct NearList {
  static constexpr std::uint32_t kMost = 12;
  std::uint64_t body = 0;  ///< ConvexBody::stamp; 0: no list
  Vec3 at = Vec3::Zero();  ///< point from the body's centre, or direction, of the list
  double rest = 0;         ///< at `at`, no value that is not listed is above this one
  std::array<std::uint32_t, kMost> index{};
  std::uint32_t count = 0;
  std::uint32_t served = 0;  ///< queries answered by this list
  std::uint32_t wait = 0;    ///< queries to let pass before another is made
};

}  // namespace osteon
