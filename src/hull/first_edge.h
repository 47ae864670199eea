#pragma once

#include <cstdint>
#include <span>

#include "cloud.h"

namespace osteon::hull {

struct DirectedEdge {
  std::uint32_t from, to;
};

/// An edge of the hull between two of its corners; exact. The points are some of the cloud, all
/// corners of its hull among them, span a volume and hold no copies.
DirectedEdge first_edge(const Cloud& cloud, std::span<const std::uint32_t> points);

}  // namespace osteon::hull
