#include "osteon/carve/grid_nodes.h"

#include <cmath>

namespace osteon {
namespace {

// `u` is whole numbers.
std::optional<GridNode> node_at(const BlockGrid& grid, const Vec3& u) {
  std::array<int, 3> at{}, in{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = u[static_cast<Eigen::Index>(k)];
    if (!(x >= 0 && x < BlockGrid::kSide * grid.blocks[k])) return std::nullopt;
    at[k] = static_cast<int>(x) / BlockGrid::kSide;
    in[k] = static_cast<int>(x) % BlockGrid::kSide;
  }
  return GridNode{grid.index(at), static_cast<std::size_t>((in[2] * 8 + in[1]) * 8 + in[0])};
}

}  // namespace

std::optional<GridNode> nearest_node(const BlockGrid& grid, const Vec3& p_B) {
  const Vec3 u = (p_B - grid.lo) / grid.cell_m;
  return node_at(grid, (u.array() + 0.5).floor().matrix());
}

std::optional<std::array<NodeShare, 8>> nodes_about(const BlockGrid& grid, const Vec3& p_B) {
  const Vec3 u = (p_B - grid.lo) / grid.cell_m;
  const Vec3 low = u.array().floor().matrix();
  const Vec3 t = u - low;
  std::array<NodeShare, 8> out;
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3 corner(c & 1, c >> 1 & 1, c >> 2);
    const auto at = node_at(grid, low + corner);
    if (!at) return std::nullopt;
    out[c].at = *at;
    out[c].share = 1;
    for (Eigen::Index k = 0; k < 3; ++k) out[c].share *= corner[k] > 0 ? t[k] : 1 - t[k];
  }
  return out;
}

}  // namespace osteon
