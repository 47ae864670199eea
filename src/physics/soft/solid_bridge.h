#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/loose_pieces.h"

namespace osteon {

/// The narrowest section of what cuts have left of a solid, between a place and what it hangs on.
struct SolidBridge {
  double area_m2 = 0;
  std::vector<Vec3> middles_B;  ///< of the pairs of nodes that it parts
  Vec3 middle_B = Vec3::Zero();
};

/// Looks for it: the least number of neighbouring nodes that must be parted (the least cut of their
/// graph, by Ford and Fulkerson), each pair a square of the grid. So a section that lies along the
/// grid has its true area, one aslant up to 1.7 times as much. Nodes of a cube of two on a side
/// that hang together count as one, or it would take too long.
class BridgeSearch {
 public:
  explicit BridgeSearch(const CarvedField& field);

  /// `hangs`: its nodes that are held. `around_m`: what is so near to the place goes with it. None:
  /// all sections are wider than `most_m2`, nothing of the solid is there, or it hangs on nothing.
  std::optional<SolidBridge> narrowest(const CarvedField& field, const LoosePieces& hangs,
                                       const Vec3& p_B, double around_m, double most_m2);

 private:
  struct Link {
    std::int32_t to = 0;
    std::int32_t room = 0;  ///< pairs of nodes that are not used yet
  };
  std::size_t at(int x, int y, int z) const;
  void take_left(const CarvedField& field);
  void label();
  void link();
  bool push_more();
  SolidBridge bridge() const;

  BlockGrid grid_;
  std::array<int, 3> n_{};
  std::vector<std::uint8_t> inside_, left_;  ///< of each node
  std::vector<std::int32_t> part_;           ///< of each node; -1: none
  std::vector<std::uint8_t> source_, sink_;  ///< of each part
  std::vector<std::int32_t> first_;          ///< of each part's links; one more at the end
  std::vector<Link> links_;
  std::vector<std::int32_t> back_;  ///< of each link the one the other way
  std::vector<std::int32_t> came_;  ///< of each part: link by which it was reached; -1: it was not
  std::int32_t flow_ = 0;
};

}  // namespace osteon
