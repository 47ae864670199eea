#pragma once

#include <array>
#include <cstdint>

#include "osteon/carve/carved_field.h"

namespace osteon {

/// Nodes of a block and two beyond each of its sides: i, j, k from -2 to 9.
struct NodeWindow {
  static constexpr int kBeyond = 2;
  static constexpr int kSpan = BlockGrid::kSide + 2 * kBeyond;
  static constexpr std::size_t kCount = std::size_t{kSpan} * kSpan * kSpan;

  std::array<std::int16_t, kCount> height, cut;  ///< um

  static constexpr int index(int i, int j, int k) {
    return ((k + kBeyond) * kSpan + j + kBeyond) * kSpan + i + kBeyond;
  }
  /// Whether bone is left at a node.
  bool left(int node) const {
    return height[static_cast<std::size_t>(node)] < 0 && cut[static_cast<std::size_t>(node)] > 0;
  }
};

/// Heights over the bone alone, without its cartilage, at the same nodes; see NodeWindow.
using BareWindow = std::array<std::int16_t, NodeWindow::kCount>;

/// Reads them. Where nothing is known to be near, heights and cuts are the farthest.
void read_window(const CarvedField& field, const std::array<int, 3>& block, NodeWindow& out);
void read_bare(const CarvedField& field, const std::array<int, 3>& block, BareWindow& out);

}  // namespace osteon
