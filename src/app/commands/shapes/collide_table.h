#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "osteon/base/percentiles.h"
#include "osteon/base/result.h"
#include "osteon/collide/convex_body.h"

namespace osteon {

/// What `osteon collide` writes, see its --help for the columns.
struct CollideTable {
  std::string csv;
  std::size_t poses = 0;
  std::size_t hits = 0;
  Percentiles times;
};

/// Tests each pose of B in A in turn, warm-started from the one before. Fails when a programme
/// ended without an answer.
Result<CollideTable> make_collide_table(const ConvexBody& a, const ConvexBody& b,
                                        std::span<const Pose> X_AB);

}  // namespace osteon
