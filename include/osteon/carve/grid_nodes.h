#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "osteon/base/types.h"
#include "osteon/carve/block_grid.h"

namespace osteon {

/// A node of a grid of blocks: which block, and which of its 512 nodes, x fastest.
struct GridNode {
  std::uint32_t block = 0;
  std::size_t node = 0;
};

/// The node nearest to a place in the grid's frame; none outside of the grid.
std::optional<GridNode> nearest_node(const BlockGrid& grid, const Vec3& p_B);

/// A node beside a place, and its share of a value that is linear between nodes.
struct NodeShare {
  GridNode at;
  double share = 0;
};

/// The eight nodes about a place; none where one of them is outside of the grid.
std::optional<std::array<NodeShare, 8>> nodes_about(const BlockGrid& grid, const Vec3& p_B);

}  // namespace osteon
