#include "node_heights.h"

#include <cmath>
#include <limits>

namespace osteon {
namespace {

constexpr int kBlockSide = 8;  // nodes along a block
constexpr std::size_t kBlockNodes = kBlockSide * kBlockSide * kBlockSide;
constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace

NodeHeights::NodeHeights(const HeightSource& surface, const Vec3& lo, double cell_m,
                         const Node& size)
    : surface_(surface), lo_(lo), cell_(cell_m) {
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    blocks_[k] = (size[k] + kBlockSide - 1) / kBlockSide;
    count *= static_cast<std::size_t>(blocks_[k]);
  }
  first_.assign(count, kNone);
}

double NodeHeights::exact(const Vec3& p) {
  const ClosestPoint found = surface_.closest(p, guess_);
  guess_ = found.triangle;
  return found.signed_distance;
}

float NodeHeights::at(const Node& node) {
  const auto block = static_cast<std::size_t>(
      (node[2] / kBlockSide * blocks_[1] + node[1] / kBlockSide) * blocks_[0] +
      node[0] / kBlockSide);
  if (first_[block] == kNone) {
    first_[block] = static_cast<std::uint32_t>(values_.size() / kBlockNodes);
    values_.resize(values_.size() + kBlockNodes, std::numeric_limits<float>::quiet_NaN());
  }
  const auto within = static_cast<std::size_t>(
      (node[2] % kBlockSide * kBlockSide + node[1] % kBlockSide) * kBlockSide +
      node[0] % kBlockSide);
  float& known = values_[first_[block] * kBlockNodes + within];
  if (std::isnan(known))
    known = static_cast<float>(exact(lo_ + cell_ * Vec3(node[0], node[1], node[2])));
  return known;
}

}  // namespace osteon
