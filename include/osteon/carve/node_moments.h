#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/carve/carved_field.h"

namespace osteon {

/// Count, sum of places and sum of their products over nodes of a grid, places in cells from the
/// grid's first node. Whole numbers: the order of adding changes no bit.
struct NodeMoments {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 6> second{};  ///< xx, yy, zz, xy, xz, yz
  void add(const NodeMoments& other, int sign);
  friend bool operator==(const NodeMoments&, const NodeMoments&) = default;
};

/// Of all nodes that lie in the uncut bone.
NodeMoments whole_nodes(const UncutField& bone);

/// Of the nodes whose bone is gone; cartilage does not count.
class RemovedNodes {
 public:
  explicit RemovedNodes(const CarvedField& field);
  /// Looks at the blocks that changed since the last call. A function of the cuts alone.
  const NodeMoments& of(const CarvedField& field);

 private:
  std::vector<NodeMoments> blocks_;  ///< of each block that holds a cut
  NodeMoments sum_;
  std::uint64_t since_ = 0, epoch_ = 0;
};

/// How many nodes are gone of each tissue, cartilage too: whole numbers, so that it costs a look at
/// what changed and the order of the cuts changes no bit. See removed_volume for the volume itself.
class RemovedTissue {
 public:
  using Counts = std::array<std::int64_t, kBoneTissues>;
  explicit RemovedTissue(const CarvedField& field);
  /// Looks at the blocks that changed since the last call. A function of the cuts alone.
  const Counts& of(const CarvedField& field);

 private:
  std::vector<Counts> blocks_;  ///< of each block that holds a cut
  Counts sum_{};
  std::uint64_t since_ = 0, epoch_ = 0;
};

}  // namespace osteon
