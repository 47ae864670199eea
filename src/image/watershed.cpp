#include "osteon/image/watershed.h"

#include <algorithm>
#include <array>
#include <queue>

namespace osteon {
namespace {

constexpr std::array<std::array<int, 3>, 6> kFaces = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Calls `visit` with the index of each neighbour by a face.
template <class F>
void each_neighbour(const GridFrame& frame, std::size_t n, F visit) {
  const auto w = static_cast<std::size_t>(frame.size[0]);
  const auto h = static_cast<std::size_t>(frame.size[1]);
  const int i = static_cast<int>(n % w), j = static_cast<int>(n / w % h),
            k = static_cast<int>(n / (w * h));
  for (const auto& d : kFaces)
    if (frame.contains(i + d[0], j + d[1], k + d[2]))
      visit(frame.index(i + d[0], j + d[1], k + d[2]));
}

struct Basin {
  std::uint32_t parent;
  float peak;
};

class Basins {
 public:
  std::uint32_t add(float peak) {
    basins_.push_back({static_cast<std::uint32_t>(basins_.size()), peak});
    return static_cast<std::uint32_t>(basins_.size() - 1);
  }
  std::uint32_t find(std::uint32_t b) {
    while (basins_[b].parent != b) b = basins_[b].parent = basins_[basins_[b].parent].parent;
    return b;
  }
  float peak(std::uint32_t b) const { return basins_[b].peak; }
  /// The one with the lower peak goes into the other.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (peak(a) < peak(b)) std::swap(a, b);
    basins_[b].parent = a;
    return a;
  }
  std::size_t size() const { return basins_.size(); }

 private:
  std::vector<Basin> basins_;
};

/// Voxels of the body, deepest first; equally deep ones in the order of memory.
std::vector<std::uint32_t> deepest_first(const Grid<float>& distance_m) {
  std::vector<std::uint32_t> order;
  for (std::size_t n = 0; n < distance_m.values.size(); ++n)
    if (distance_m.values[n] > 0) order.push_back(static_cast<std::uint32_t>(n));
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance_m.values[a] > distance_m.values[b];
  });
  return order;
}

bool is_one_body(float lower_peak, float pass, const NeckOptions& options) {
  return pass >= options.widest_neck * lower_peak || lower_peak - pass < options.least_height_m;
}

}  // namespace

int split_at_necks(const Grid<float>& distance_m, const NeckOptions& options, LabelVolume& labels) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  const GridFrame& frame = distance_m.frame;
  std::vector<std::uint32_t> basin_of(frame.count(), kNone);
  Basins basins;
  const std::vector<std::uint32_t> order = deepest_first(distance_m);
  for (const std::uint32_t n : order) {
    const float depth = distance_m.values[n];
    std::uint32_t mine = kNone;
    each_neighbour(frame, n, [&](std::size_t m) {
      if (basin_of[m] == kNone) return;
      const std::uint32_t other = basins.find(basin_of[m]);
      if (mine == kNone || mine == other) {
        mine = other;
      } else if (is_one_body(std::min(basins.peak(mine), basins.peak(other)), depth, options)) {
        mine = basins.join(mine, other);
      } else if (basins.peak(other) > basins.peak(mine)) {
        mine = other;
      }
    });
    basin_of[n] = mine == kNone ? basins.add(depth) : mine;
  }
  std::vector<std::uint16_t> number(basins.size(), 0);
  labels.frame = frame;
  labels.values.assign(frame.count(), 0);
  int count = 0;
  for (const std::uint32_t n : order) {
    const std::uint32_t root = basins.find(basin_of[n]);
    if (number[root] == 0) number[root] = static_cast<std::uint16_t>(std::min(++count, 65535));
    labels.values[n] = number[root];
  }
  return count;
}

void grow_seeds(const Volume& height, const Mask& mask, LabelVolume& seeds) {
  // Buckets of equal height, each first in, first out.
  constexpr int kLow = -1024, kBuckets = 5120;
  std::vector<std::queue<std::uint32_t>> buckets(kBuckets);
  int top = 0;
  const auto push = [&](std::size_t n) {
    const int bucket = std::clamp(height.values[n] - kLow, 0, kBuckets - 1);
    buckets[static_cast<std::size_t>(bucket)].push(static_cast<std::uint32_t>(n));
    top = std::max(top, bucket);
  };
  for (std::size_t n = 0; n < seeds.values.size(); ++n)
    if (seeds.values[n] && mask.values[n]) push(n);
  while (top >= 0) {
    auto& bucket = buckets[static_cast<std::size_t>(top)];
    if (bucket.empty()) {
      --top;
      continue;
    }
    const std::uint32_t n = bucket.front();
    bucket.pop();
    each_neighbour(seeds.frame, n, [&](std::size_t m) {
      if (seeds.values[m] || !mask.values[m]) return;
      seeds.values[m] = seeds.values[n];
      push(m);
    });
  }
}

}  // namespace osteon
