#include "osteon/carve/uncut_field.h"

#include <algorithm>
#include <cmath>

namespace osteon {

UncutField::Place UncutField::place(std::uint32_t block) const {
  const std::uint32_t slot = slot_[block];
  return slot == kOut ? Place::kOutside : slot == kIn ? Place::kDeep : Place::kStored;
}

const std::int16_t* UncutField::stored(std::uint32_t block) const {
  return place(block) == Place::kStored
             ? heights_.data() + std::size_t{slot_[block]} * BlockGrid::kNodes
             : nullptr;
}

void UncutField::heights(std::uint32_t block,
                         std::span<std::int16_t, BlockGrid::kNodes> out) const {
  if (const std::int16_t* from = stored(block)) {
    std::copy_n(from, BlockGrid::kNodes, out.begin());
  } else if (place(block) == Place::kDeep) {
    deep_heights(block, out);
  } else {
    std::fill(out.begin(), out.end(), kFar);
  }
}

// Linear along each axis between the middles of blocks, and no higher than a deep node can be.
void UncutField::deep_heights(std::uint32_t block,
                              std::span<std::int16_t, BlockGrid::kNodes> out) const {
  const auto at = grid_.place(block);
  const auto middle = [&](int i, int j, int k) {
    std::array<int, 3> near{at[0] + i, at[1] + j, at[2] + k};
    for (std::size_t a = 0; a < 3; ++a) near[a] = std::clamp(near[a], 0, grid_.blocks[a] - 1);
    return static_cast<double>(middle_[grid_.index(near)]);
  };
  std::array<double, 27> around{};
  for (int n = 0; n < 27; ++n)
    around[static_cast<std::size_t>(n)] = middle(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
  // Place of a node among three middles: the lower one of two, and the way to the upper.
  const auto part = [](int node) {
    const double x = (node - 3.5) / BlockGrid::kSide + 1;
    const int low = x < 1 ? 0 : 1;
    return std::pair(static_cast<std::size_t>(low), x - low);
  };
  const double highest = -3e6 * grid_.cell_m;
  for (int n = 0; n < static_cast<int>(BlockGrid::kNodes); ++n) {
    const auto [i, x] = part(n % 8);
    const auto [j, y] = part(n / 8 % 8);
    const auto [k, z] = part(n / 64);
    const auto row = [&, i = i, x = x](std::size_t jj, std::size_t kk) {
      const std::size_t first = 9 * kk + 3 * jj + i;
      return (1 - x) * around[first] + x * around[first + 1];
    };
    const double lower = (1 - y) * row(j, k) + y * row(j + 1, k);
    const double upper = (1 - y) * row(j, k + 1) + y * row(j + 1, k + 1);
    const double um = 1e6 * ((1 - z) * lower + z * upper);
    out[static_cast<std::size_t>(n)] =
        static_cast<std::int16_t>(std::round(std::clamp(um, -32767.0, highest)));
  }
}

std::size_t UncutField::bytes() const {
  return middle_.size() * sizeof(float) + slot_.size() * sizeof(std::uint32_t) +
         heights_.size() * sizeof(std::int16_t) + (bare_ ? bare_->bytes() : 0);
}

}  // namespace osteon
