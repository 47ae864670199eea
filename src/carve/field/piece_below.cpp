#include "osteon/carve/piece_below.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "osteon/carve/grid_nodes.h"

namespace osteon {
namespace {

/// Heights of a field's nodes, asked for one by one.
class NodeHeights {
 public:
  explicit NodeHeights(const UncutField& field) : field_(field) {}
  /// um; outside of the grid far away.
  std::int16_t at(const Vec3& p_B) {
    const auto near = nearest_node(field_.grid(), p_B);
    if (!near) return UncutField::kFar;
    if (const std::int16_t* stored = field_.stored(near->block)) return stored[near->node];
    if (block_ != near->block) field_.heights(near->block, heights_);
    block_ = near->block;
    return heights_[near->node];
  }

 private:
  const UncutField& field_;
  std::optional<std::uint32_t> block_;  // that heights_ are of
  std::array<std::int16_t, BlockGrid::kNodes> heights_{};
};

}  // namespace

std::shared_ptr<const PieceShape> piece_below(const PieceShape& piece, const UncutField& bone,
                                              double depth_m) {
  PieceGrid grid = piece.grid();
  NodeHeights over(bone.bare() ? *bone.bare() : bone);
  const auto depth_um = static_cast<int>(std::lround(1e6 * std::clamp(depth_m, 0.0, 0.03)));
  std::size_t n = 0;
  for (int k = 0; k < grid.nodes[2]; ++k)
    for (int j = 0; j < grid.nodes[1]; ++j)
      for (int i = 0; i < grid.nodes[0]; ++i, ++n) {
        const int below = over.at(grid.lo_B + grid.cell_m * Vec3(i, j, k)) + depth_um;
        const int level = std::max<int>(grid.heights[n], below);
        grid.heights[n] = static_cast<std::int16_t>(std::min<int>(level, UncutField::kFar));
      }
  return PieceShape::from(std::move(grid));
}

}  // namespace osteon
