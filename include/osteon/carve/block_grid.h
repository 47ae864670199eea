#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// Nodes in cubes of 8 x 8 x 8, x fastest. Node (i, j, k) stands at lo + cell (i, j, k) in Bone and
/// belongs to block (i / 8, j / 8, k / 8).
struct BlockGrid {
  static constexpr int kSide = 8;
  static constexpr std::size_t kNodes = 512;  ///< of a block

  double cell_m = 0;
  Vec3 lo = Vec3::Zero();
  std::array<int, 3> blocks{};

  std::size_t count() const {
    return static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) *
           static_cast<std::size_t>(blocks[2]);
  }
  bool holds(const std::array<int, 3>& at) const {
    return at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < blocks[0] && at[1] < blocks[1] &&
           at[2] < blocks[2];
  }
  std::uint32_t index(const std::array<int, 3>& at) const {
    return static_cast<std::uint32_t>((at[2] * blocks[1] + at[1]) * blocks[0] + at[0]);
  }
  std::array<int, 3> place(std::uint32_t block) const {
    const int b = static_cast<int>(block);
    return {b % blocks[0], b / blocks[0] % blocks[1], b / blocks[0] / blocks[1]};
  }
  Vec3 node(int i, int j, int k) const { return lo + cell_m * Vec3(i, j, k); }
  double block_m() const { return kSide * cell_m; }
  /// Middle of a block's nodes.
  Vec3 middle(const std::array<int, 3>& at) const {
    return lo + cell_m * Vec3(kSide * at[0] + 3.5, kSide * at[1] + 3.5, kSide * at[2] + 3.5);
  }
  /// From there to its farthest node.
  double reach_m() const { return 3.5 * 1.7320508075688772 * cell_m; }
  friend bool operator==(const BlockGrid& a, const BlockGrid& b) {
    return a.cell_m == b.cell_m && a.lo == b.lo && a.blocks == b.blocks;
  }
};

}  // namespace osteon
