#include "spatial_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "cube_map.h"
#include "exact/predicates.h"

namespace osteon::hull {

namespace {

constexpr std::uint32_t kLevels = 12;  ///< of the curve: 2^12 cells along an edge of a face
constexpr std::uint32_t kDigit = 9;    ///< bits that one pass of the sort takes
constexpr std::uint32_t kDigits = 3;   ///< 3 bits of face and 2 kLevels are 27

struct Placed {
  std::uint32_t key;
  std::uint32_t point;
};

/// Hilbert's curve through a square of 8 by 8 cells, for each of the four ways in which it lies:
/// turned over the diagonal (1), run through from the other end (2).
struct CurveStep {
  std::uint8_t place;  ///< of the cell along the curve
  std::uint8_t lie;    ///< of the curve within the cell
};

constexpr CurveStep curve_step(std::uint32_t lie, std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (std::uint32_t bit = 3; bit-- > 0;) {
    const std::uint32_t flip = lie >> 1;
    const std::uint32_t x_bit = ((x >> bit) & 1) ^ flip, y_bit = ((y >> bit) & 1) ^ flip;
    const std::uint32_t right = lie & 1 ? y_bit : x_bit, upper = lie & 1 ? x_bit : y_bit;
    place = 4 * place + ((3 * right) ^ upper);
    if (upper == 0) lie ^= right ? 3 : 1;
  }
  return {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(lie)};
}

constexpr std::array<CurveStep, 256> curve_steps() {
  std::array<CurveStep, 256> steps{};
  for (std::uint32_t i = 0; i < 256; ++i) steps[i] = curve_step(i >> 6, (i >> 3) & 7, i & 7);
  return steps;
}

constexpr std::array<CurveStep, 256> kCurve = curve_steps();

/// Place of a cell along Hilbert's curve through a square of 2^kLevels cells along an edge.
std::uint32_t along_curve(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0, lie = 0;
  for (std::uint32_t shift = kLevels; shift > 0;) {
    shift -= 3;
    const CurveStep step = kCurve[(lie << 6) + (((x >> shift) & 7) << 3) + ((y >> shift) & 7)];
    place = (place << 6) + step.place;
    lie = step.lie;
  }
  return place;
}

std::uint32_t key_of(const Vec3& q) {
  const CubeSpot spot = cube_spot(q);
  if (!(spot.reach > 0)) return 0;
  constexpr std::uint32_t kSide = 1u << kLevels;
  return (spot.face << (2 * kLevels)) + along_curve(part_of(spot.u, kSide), part_of(spot.v, kSide));
}

/// By key, keeping the order of equal ones.
void sort_by_key(std::vector<Placed>& items) {
  std::vector<Placed> other(items.size());
  for (std::uint32_t digit = 0; digit < kDigits; ++digit) {
    const auto value = [&](const Placed& item) {
      return (item.key >> (digit * kDigit)) & ((1u << kDigit) - 1);
    };
    std::array<std::uint32_t, 1u << kDigit> start{};
    for (const Placed& item : items) ++start[value(item)];
    std::uint32_t total = 0;
    for (std::uint32_t& s : start) total += std::exchange(s, total);
    for (const Placed& item : items) other[start[value(item)]++] = item;
    items.swap(other);
  }
}

/// Takes the points of one key, which may hold copies.
class Deduplicator {
 public:
  Deduplicator(const Cloud& cloud, Polytope& polytope)
      : cloud_(cloud), polytope_(polytope), vertex_at_(cloud.size(), kNoIndex) {
    for (std::uint32_t v = 0; v < polytope.vertices().size(); ++v) {
      vertex_at_[polytope.vertices()[v].source] = v;
    }
  }

  void take(std::span<Placed> items, SpatialOrder& order) {
    if (items.size() > 1) sort_by_place(items);
    for (std::size_t i = 0; i < items.size();) {
      const std::uint32_t point = items[i].point;
      std::uint32_t vertex = kNoIndex;
      const std::size_t first = i;
      for (; i < items.size() && cloud_.raw(items[i].point) == cloud_.raw(point); ++i) {
        if (vertex_at_[items[i].point] != kNoIndex) vertex = vertex_at_[items[i].point];
      }
      order.copies += i - first - 1;
      if (vertex == kNoIndex) {
        order.points.push_back(point);
      } else {
        polytope_.rename(vertex, point);
      }
    }
  }

 private:
  void sort_by_place(std::span<Placed> items) const {
    std::sort(items.begin(), items.end(), [this](const Placed& a, const Placed& b) {
      if (cloud_.raw(a.point) == cloud_.raw(b.point)) return a.point < b.point;
      return lexicographic_less(cloud_.raw(a.point), cloud_.raw(b.point));
    });
  }

  const Cloud& cloud_;
  Polytope& polytope_;
  std::vector<std::uint32_t> vertex_at_;  ///< of the polytope, by point
};

}  // namespace

SpatialOrder spatial_order(const Cloud& cloud, Polytope& polytope,
                           std::span<const std::uint32_t> points) {
  std::vector<Placed> items;
  items.reserve(points.size());
  for (const std::uint32_t i : points) items.push_back({key_of(polytope.to_q(cloud.raw(i))), i});
  sort_by_key(items);
  SpatialOrder order;
  order.points.reserve(points.size());
  Deduplicator deduplicator(cloud, polytope);
  for (std::size_t i = 0; i < items.size();) {
    std::size_t end = i + 1;
    while (end < items.size() && items[end].key == items[i].key) ++end;
    deduplicator.take({items.data() + i, end - i}, order);
    i = end;
  }
  return order;
}

}  // namespace osteon::hull
