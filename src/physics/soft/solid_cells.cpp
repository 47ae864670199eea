#include "soft/solid_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace osteon {
namespace {

constexpr std::uint8_t kGone = 0, kUnseen = 255;
constexpr std::uint8_t kOther = 254;  // of a part beyond the four largest

}  // namespace

std::size_t SolidCells::node(int x, int y, int z) const {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(n_[1]) +
          static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(n_[0]) +
         static_cast<std::size_t>(x);
}

SolidCells::SolidCells(const CarvedField& field, const PressedSolid& whole)
    : grid_(field.grid()), cells_(whole.cells()) {
  std::size_t all = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    n_[k] = grid_.blocks[k] * BlockGrid::kSide;
    all *= static_cast<std::size_t>(n_[k]);
  }
  inside_.assign(all, 0);
  label_.assign(all, kGone);
  std::array<std::int16_t, BlockGrid::kNodes> heights{};
  for (std::uint32_t b = 0; b < grid_.count(); ++b) {
    field.bone().heights(b, heights);
    const auto at = grid_.place(b);
    for (int i = 0; i < static_cast<int>(BlockGrid::kNodes); ++i)
      inside_[node(8 * at[0] + i % 8, 8 * at[1] + i / 8 % 8, 8 * at[2] + i / 64)] =
          heights[static_cast<std::size_t>(i)] < 0 ? 1 : 0;
  }
  std::map<std::array<long, 3>, std::int32_t> places;
  const Vec3 lo = whole.cell_lo(0);
  const auto place_of = [&](std::size_t e) {
    const Vec3 at = (whole.cell_lo(e) - lo) / whole.cell_m();
    return std::array<long, 3>{std::lround(at.x()), std::lround(at.y()), std::lround(at.z())};
  };
  for (std::size_t e = 0; e < whole.cells(); ++e) {
    places[place_of(e)] = static_cast<std::int32_t>(e);
    Range range;
    const Vec3 from = (whole.cell_lo(e) - grid_.lo) / grid_.cell_m;
    const double size = whole.cell_m() / grid_.cell_m;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      range.lo[k] = std::clamp(static_cast<int>(std::ceil(from[axis])), 0, n_[k]);
      range.hi[k] = std::clamp(static_cast<int>(std::ceil(from[axis] + size)), 0, n_[k]);
    }
    ranges_.push_back(range);
    std::uint32_t count = 0;
    for (int z = range.lo[2]; z < range.hi[2]; ++z)
      for (int y = range.lo[1]; y < range.hi[1]; ++y)
        for (int x = range.lo[0]; x < range.hi[0]; ++x) count += inside_[node(x, y, z)];
    whole_.push_back(count);
  }
  for (std::size_t e = 0; e < whole.cells(); ++e) {
    after_.push_back({-1, -1, -1});
    for (std::size_t k = 0; k < 3; ++k) {
      auto at = place_of(e);
      at[k] += 1;
      if (const auto it = places.find(at); it != places.end()) after_[e][k] = it->second;
    }
  }
  touched_.assign(cells_.size(), 0);
  stack_.reserve(all);
  update_all(field);
}

void SolidCells::update_all(const CarvedField& field) {
  for (std::size_t i = 0; i < inside_.size(); ++i) label_[i] = inside_[i] ? kUnseen : kGone;
  for (std::size_t n = 0; n < field.block_count(); ++n) take(field, field.block_at(n));
  std::fill(touched_.begin(), touched_.end(), std::uint8_t{1});
  look_again();
}

void SolidCells::update(const CarvedField& field, std::uint64_t since) {
  for (std::size_t n = 0; n < field.block_count(); ++n)
    if (field.changed_at(n) > since) take(field, field.block_at(n));
  look_again();
}

// Marks the cells that hold a node of the block.
void SolidCells::take(const CarvedField& field, std::uint32_t block) {
  const std::int16_t* cuts = field.cuts(block);
  const auto at = grid_.place(block);
  for (int i = 0; cuts && i < static_cast<int>(BlockGrid::kNodes); ++i) {
    const std::size_t k = node(8 * at[0] + i % 8, 8 * at[1] + i / 8 % 8, 8 * at[2] + i / 64);
    label_[k] = inside_[k] && cuts[i] > 0 ? kUnseen : kGone;
  }
  for (std::size_t e = 0; e < ranges_.size(); ++e) {
    bool by = true;
    for (std::size_t k = 0; k < 3; ++k)
      by = by && ranges_[e].lo[k] < 8 * at[k] + 8 && ranges_[e].hi[k] > 8 * at[k];
    if (by) touched_[e] = 1;
  }
}

void SolidCells::look_again() {
  for (std::size_t e = 0; e < cells_.size(); ++e)
    if (touched_[e]) label(e);
  for (std::size_t e = 0; e < cells_.size(); ++e)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t beyond = after_[e][static_cast<std::size_t>(k)];
      if (touched_[e] || (beyond >= 0 && touched_[static_cast<std::size_t>(beyond)])) link(e, k);
    }
  std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
}

// Connected along the axes inside of the cell; the four largest parts count, of equals the first.
void SolidCells::label(std::size_t cell) {
  const Range& range = ranges_[cell];
  struct Part {
    std::uint32_t nodes = 0;
    Vec3 sum = Vec3::Zero();
    std::uint32_t seed = 0;
  };
  std::array<Part, CutCell::kParts> best{};
  const auto each = [&](const auto& what) {
    for (int z = range.lo[2]; z < range.hi[2]; ++z)
      for (int y = range.lo[1]; y < range.hi[1]; ++y)
        for (int x = range.lo[0]; x < range.hi[0]; ++x) what(x, y, z);
  };
  const auto flood = [&](std::size_t seed, std::uint8_t from, std::uint8_t to) {
    Part part;
    part.seed = static_cast<std::uint32_t>(seed);
    stack_.clear();
    stack_.push_back(part.seed);
    label_[seed] = to;
    while (!stack_.empty()) {
      const std::uint32_t i = stack_.back();
      stack_.pop_back();
      const std::array<int, 3> at{static_cast<int>(i) % n_[0], static_cast<int>(i) / n_[0] % n_[1],
                                  static_cast<int>(i) / n_[0] / n_[1]};
      ++part.nodes;
      part.sum += grid_.node(at[0], at[1], at[2]);
      for (std::size_t k = 0; k < 3; ++k)
        for (const int way : {-1, 1}) {
          std::array<int, 3> next = at;
          next[k] += way;
          if (next[k] < range.lo[k] || next[k] >= range.hi[k]) continue;
          const std::size_t j = node(next[0], next[1], next[2]);
          if (label_[j] != from) continue;
          label_[j] = to;
          stack_.push_back(static_cast<std::uint32_t>(j));
        }
    }
    return part;
  };
  each([&](int x, int y, int z) {
    std::uint8_t& is = label_[node(x, y, z)];
    if (is != kGone) is = kUnseen;
  });
  each([&](int x, int y, int z) {
    const std::size_t i = node(x, y, z);
    if (label_[i] != kUnseen) return;
    const Part part = flood(i, kUnseen, kOther);
    auto place = std::find_if(best.begin(), best.end(),
                              [&](const Part& other) { return other.nodes < part.nodes; });
    if (place == best.end()) return;
    std::copy_backward(place, best.end() - 1, best.end());
    *place = part;
  });
  CutCell out;
  for (const Part& part : best) {
    if (part.nodes == 0) break;
    (void)flood(part.seed, kOther, static_cast<std::uint8_t>(1 + out.count));
    out.left[out.count] = static_cast<double>(part.nodes) / std::max(whole_[cell], 1u);
    out.middle[out.count] = part.sum / static_cast<double>(part.nodes);
    ++out.count;
  }
  cells_[cell] = out;
}

void SolidCells::link(std::size_t cell, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  std::uint16_t bits = 0;
  const std::int32_t beyond = after_[cell][k];
  Range range = ranges_[cell];
  range.lo[k] = range.hi[k] - 1;
  const std::size_t stride =
      k == 0   ? 1
      : k == 1 ? static_cast<std::size_t>(n_[0])
               : static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]);
  if (beyond >= 0 && range.lo[k] >= 0 && range.hi[k] < n_[k])
    for (int z = range.lo[2]; z < range.hi[2]; ++z)
      for (int y = range.lo[1]; y < range.hi[1]; ++y)
        for (int x = range.lo[0]; x < range.hi[0]; ++x) {
          const std::uint8_t a = label_[node(x, y, z)], b = label_[node(x, y, z) + stride];
          if (a >= 1 && a <= CutCell::kParts && b >= 1 && b <= CutCell::kParts)
            bits |= static_cast<std::uint16_t>(1u << (4 * (a - 1) + (b - 1)));
        }
  cells_[cell].beyond[k] = bits;
}

}  // namespace osteon
