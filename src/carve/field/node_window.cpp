#include "field/node_window.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr std::int16_t kFar = UncutField::kFar;

/// What a neighbour has to give along one axis: its nodes from `first` on, to the window's `to`.
struct Share {
  int first, to, count;
};

Share share_of(int step) {
  if (step < 0)
    return {BlockGrid::kSide - NodeWindow::kBeyond, -NodeWindow::kBeyond, NodeWindow::kBeyond};
  if (step > 0) return {0, BlockGrid::kSide, NodeWindow::kBeyond};
  return {0, 0, BlockGrid::kSide};
}

/// Copies from a block's nodes, or fills where it has none.
void put(const std::int16_t* from, std::int16_t other, const std::array<Share, 3>& share,
         std::array<std::int16_t, NodeWindow::kCount>& out) {
  const auto [x, y, z] = share;
  for (int k = 0; k < z.count; ++k)
    for (int j = 0; j < y.count; ++j) {
      std::int16_t* to = out.data() + NodeWindow::index(x.to, y.to + j, z.to + k);
      if (from)
        std::copy_n(from + 64 * (z.first + k) + 8 * (y.first + j) + x.first, x.count, to);
      else
        std::fill_n(to, x.count, other);
    }
}

}  // namespace

void read_window(const CarvedField& field, const std::array<int, 3>& block, NodeWindow& out) {
  const BlockGrid& grid = field.grid();
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const std::array<int, 3> at{block[0] + step[0], block[1] + step[1], block[2] + step[2]};
    const std::array<Share, 3> share{share_of(step[0]), share_of(step[1]), share_of(step[2])};
    if (!grid.holds(at)) {
      put(nullptr, kFar, share, out.height);
      put(nullptr, kFar, share, out.cut);
      continue;
    }
    const std::uint32_t index = grid.index(at);
    const bool deep = field.bone().place(index) == UncutField::Place::kDeep;
    const std::int16_t* heights = field.heights(index);
    put(heights ? heights : field.bone().stored(index), deep ? -kFar : kFar, share, out.height);
    put(field.cuts(index), kFar, share, out.cut);
  }
}

void read_bare(const CarvedField& field, const std::array<int, 3>& block, BareWindow& out) {
  const BlockGrid& grid = field.grid();
  const UncutField& bone = field.bone().bare() ? *field.bone().bare() : field.bone();
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const std::array<int, 3> at{block[0] + step[0], block[1] + step[1], block[2] + step[2]};
    const std::array<Share, 3> share{share_of(step[0]), share_of(step[1]), share_of(step[2])};
    const std::uint32_t index = grid.holds(at) ? grid.index(at) : 0;
    if (!grid.holds(at)) {
      put(nullptr, kFar, share, out);
      continue;
    }
    const bool deep = bone.place(index) == UncutField::Place::kDeep;
    const std::int16_t* heights = field.bare_heights(index);
    put(heights ? heights : bone.stored(index), deep ? -kFar : kFar, share, out);
  }
}

}  // namespace osteon
