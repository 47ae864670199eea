#pragma once

#include <cstdint>

#include "cloud.h"

namespace osteon::hull {

struct DirectedEdge {
  std::uint32_t from, to;
};

/// An edge of the hull between two of its corners; exact. The points span a volume and hold no
/// copies.
DirectedEdge first_edge(const Cloud& cloud);

}  // namespace osteon::hull
