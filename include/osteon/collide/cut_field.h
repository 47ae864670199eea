#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/collide/distance_field.h"

namespace osteon {

/// Where nodes of a grid of cuts stand: node (i, j, k) at lo + cell (i, j, k) in Bone, in blocks of
/// 8 x 8 x 8, x fastest, blocks as well.
struct CutGrid {
  double cell_m = 0;
  Vec3 lo = Vec3::Zero();
  std::array<int, 3> blocks{};
  std::size_t count() const {
    return static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) *
           static_cast<std::size_t>(blocks[2]);
  }
};

/// What was cut out of a bone, as a hand feels it: signed distances to all cuts at nodes, negative
/// where bone is gone, in whole micrometres, and cubic B-splines over them, whose normals have no
/// jumps. A copy of its own for each who asks in a tick: blocks come from the holder of the carved
/// bone. Allocates in its constructor only.
class CutField {
 public:
  static constexpr int kSide = 8;
  static constexpr std::size_t kNodes = 512;
  static constexpr std::int16_t kUncut = 32767;
  using Block = std::span<const std::int16_t, kNodes>;

  /// At most `most_blocks` blocks hold cuts. Walls stand `slack_m` behind where they were cut, so
  /// that what cut a hole moves in it.
  CutField(const CutGrid& grid, std::size_t most_blocks, double slack_m);

  /// Replaces a block. False: there is no such block, or no room for it; nothing was done.
  bool set(std::uint32_t block, Block cut);
  void clear();
  bool empty() const { return used_ == 0; }
  std::size_t used() const { return used_; }
  /// How often anything was set or cleared: the cuts are as they were while this is.
  std::uint64_t changes() const { return changes_; }
  const CutGrid& grid() const { return grid_; }

  /// Height of a point over what the cuts have left: positive in a hole. False: no cut is near.
  bool height(const Vec3& p_B, FieldSample& out) const;
  /// Its distance alone, the same bits in less time.
  bool distance(const Vec3& p_B, double& out) const;

 private:
  using Nodes = std::array<std::int16_t, kNodes>;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Around;
  bool find(const Vec3& p_B, Around& out) const;

  CutGrid grid_;
  double slack_m_;
  double farthest_um_;  ///< cuts farther off than this are not known
  std::vector<std::uint32_t> slot_;
  std::vector<std::uint32_t> block_of_;  ///< of each slot
  std::vector<Nodes> nodes_;
  std::size_t used_ = 0;
  std::uint64_t changes_ = 0;
};

}  // namespace osteon
