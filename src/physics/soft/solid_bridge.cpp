#include "soft/solid_bridge.h"

#include <algorithm>
#include <array>
#include <limits>

namespace osteon {
namespace {

constexpr int kBridgeCube = 2;
constexpr std::int32_t kNoLink = -1, kAtSource = -2;

}  // namespace

std::size_t BridgeSearch::at(int x, int y, int z) const {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(n_[1]) +
          static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(n_[0]) +
         static_cast<std::size_t>(x);
}

BridgeSearch::BridgeSearch(const CarvedField& field) : grid_(field.grid()) {
  std::size_t all = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    n_[k] = grid_.blocks[k] * BlockGrid::kSide;
    all *= static_cast<std::size_t>(n_[k]);
  }
  inside_.assign(all, 0);
  std::array<std::int16_t, BlockGrid::kNodes> heights{};
  for (std::uint32_t b = 0; b < grid_.count(); ++b) {
    field.bone().heights(b, heights);
    const auto place = grid_.place(b);
    for (int i = 0; i < static_cast<int>(BlockGrid::kNodes); ++i)
      inside_[at(8 * place[0] + i % 8, 8 * place[1] + i / 8 % 8, 8 * place[2] + i / 64)] =
          heights[static_cast<std::size_t>(i)] < 0 ? 1 : 0;
  }
}

void BridgeSearch::take_left(const CarvedField& field) {
  left_ = inside_;
  for (std::size_t n = 0; n < field.block_count(); ++n) {
    const std::uint32_t b = field.block_at(n);
    const std::int16_t* cuts = field.cuts(b);
    const auto place = grid_.place(b);
    for (int i = 0; cuts && i < static_cast<int>(BlockGrid::kNodes); ++i)
      if (cuts[i] <= 0)
        left_[at(8 * place[0] + i % 8, 8 * place[1] + i / 8 % 8, 8 * place[2] + i / 64)] = 0;
  }
}

// Parts: nodes that hang together within their cube.
void BridgeSearch::label() {
  part_.assign(left_.size(), -1);
  std::int32_t parts = 0;
  std::array<std::array<int, 3>, kBridgeCube * kBridgeCube * kBridgeCube> stack{};
  const auto flood = [&](int x, int y, int z) {
    std::size_t count = 0;
    stack[count++] = {x, y, z};
    part_[at(x, y, z)] = parts;
    while (count > 0) {
      const std::array<int, 3> p = stack[--count];
      for (std::size_t k = 0; k < 3; ++k)
        for (const int step : {-1, 1}) {
          std::array<int, 3> q = p;
          q[k] += step;
          if (q[k] < 0 || q[k] >= n_[k] || q[k] / kBridgeCube != p[k] / kBridgeCube) continue;
          const std::size_t i = at(q[0], q[1], q[2]);
          if (!left_[i] || part_[i] >= 0) continue;
          part_[i] = parts;
          stack[count++] = q;
        }
    }
    ++parts;
  };
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x)
        if (const std::size_t i = at(x, y, z); left_[i] && part_[i] < 0) flood(x, y, z);
  source_.assign(static_cast<std::size_t>(parts), 0);
  sink_.assign(static_cast<std::size_t>(parts), 0);
}

// Of two parts that meet, as much room either way as they have pairs of nodes.
void BridgeSearch::link() {
  const std::array<std::size_t, 3> stride = {
      1, static_cast<std::size_t>(n_[0]),
      static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1])};
  const auto each_pair = [&](const auto& visit) {
    for (int z = 0; z < n_[2]; ++z)
      for (int y = 0; y < n_[1]; ++y)
        for (int x = 0; x < n_[0]; ++x) {
          const std::size_t i = at(x, y, z);
          const std::array<int, 3> p = {x, y, z};
          for (std::size_t k = 0; k < 3 && part_[i] >= 0; ++k) {
            if ((p[k] + 1) % kBridgeCube != 0 || p[k] + 1 >= n_[k]) continue;
            if (const std::int32_t b = part_[i + stride[k]]; b >= 0) visit(part_[i], b);
          }
        }
  };
  // By the first of them, then by the other: equal pairs stand together.
  std::vector<std::int32_t> begin(source_.size() + 1, 0);
  each_pair([&](std::int32_t a, std::int32_t b) {
    ++begin[static_cast<std::size_t>(a) + 1];
    ++begin[static_cast<std::size_t>(b) + 1];
  });
  for (std::size_t p = 0; p + 1 < begin.size(); ++p) begin[p + 1] += begin[p];
  std::vector<std::int32_t> met(static_cast<std::size_t>(begin.back())),
      next(begin.begin(), begin.end() - 1);
  each_pair([&](std::int32_t a, std::int32_t b) {
    met[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = b;
    met[static_cast<std::size_t>(next[static_cast<std::size_t>(b)]++)] = a;
  });
  links_.clear();
  first_.assign(source_.size() + 1, 0);
  for (std::size_t p = 0; p < source_.size(); ++p) {
    const auto from = met.begin() + begin[p], end = met.begin() + begin[p + 1];
    std::sort(from, end);
    for (auto it = from; it != end;) {
      const auto beyond = std::upper_bound(it, end, *it);
      links_.push_back({*it, static_cast<std::int32_t>(beyond - it)});
      it = beyond;
    }
    first_[p + 1] = static_cast<std::int32_t>(links_.size());
  }
  back_.assign(links_.size(), kNoLink);
  for (std::size_t p = 0; p + 1 < first_.size(); ++p)
    for (std::int32_t l = first_[p]; l < first_[p + 1]; ++l) {
      const auto to = static_cast<std::size_t>(links_[static_cast<std::size_t>(l)].to);
      const auto from = links_.begin() + first_[to], end = links_.begin() + first_[to + 1];
      const auto same =
          std::lower_bound(from, end, static_cast<std::int32_t>(p),
                           [](const Link& link, std::int32_t part) { return link.to < part; });
      back_[static_cast<std::size_t>(l)] = static_cast<std::int32_t>(same - links_.begin());
    }
}

// Symbols: a part is a node of the graph, a link's room the pairs of nodes that no way uses yet.
// Invariant: what flows into a part flows out of it, but where it starts and where it is held.
// Source: Edmonds and Karp, J. ACM 19 (1972). Ends: each way is the shortest that has room and
// fills a link, and a link is filled at most half as often as there are parts. False: there is no
// way, and what was reached is parted from the rest by the least cut.
bool BridgeSearch::push_more() {
  came_.assign(source_.size(), kNoLink);
  std::vector<std::int32_t> queue;
  for (std::size_t p = 0; p < source_.size(); ++p)
    if (source_[p]) {
      came_[p] = kAtSource;
      queue.push_back(static_cast<std::int32_t>(p));
    }
  for (std::size_t n = 0; n < queue.size(); ++n) {
    const auto p = static_cast<std::size_t>(queue[n]);
    if (sink_[p]) {
      std::int32_t room = std::numeric_limits<std::int32_t>::max();
      const auto walk = [&](const auto& visit) {
        for (std::int32_t q = queue[n]; came_[static_cast<std::size_t>(q)] != kAtSource;) {
          const auto l = static_cast<std::size_t>(came_[static_cast<std::size_t>(q)]);
          visit(l);
          q = links_[static_cast<std::size_t>(back_[l])].to;
        }
      };
      walk([&](std::size_t l) { room = std::min(room, links_[l].room); });
      walk([&](std::size_t l) {
        links_[l].room -= room;
        links_[static_cast<std::size_t>(back_[l])].room += room;
      });
      flow_ += room;
      return true;
    }
    for (std::int32_t l = first_[p]; l < first_[p + 1]; ++l) {
      const Link& link = links_[static_cast<std::size_t>(l)];
      if (link.room <= 0 || came_[static_cast<std::size_t>(link.to)] != kNoLink) continue;
      came_[static_cast<std::size_t>(link.to)] = l;
      queue.push_back(link.to);
    }
  }
  return false;
}

// What the last search reached is on the place's side.
SolidBridge BridgeSearch::bridge() const {
  SolidBridge out;
  out.area_m2 = flow_ * grid_.cell_m * grid_.cell_m;
  const auto reached = [&](std::int32_t p) {
    return came_[static_cast<std::size_t>(p)] != kNoLink;
  };
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x) {
        const std::int32_t a = part_[at(x, y, z)];
        if (a < 0) continue;
        const std::array<int, 3> p = {x, y, z};
        for (std::size_t k = 0; k < 3; ++k) {
          std::array<int, 3> q = p;
          if (++q[k] >= n_[k]) continue;
          const std::int32_t b = part_[at(q[0], q[1], q[2])];
          if (b < 0 || a == b || reached(a) == reached(b)) continue;
          out.middles_B.push_back(0.5 * (grid_.node(x, y, z) + grid_.node(q[0], q[1], q[2])));
          out.middle_B += out.middles_B.back();
        }
      }
  if (!out.middles_B.empty()) out.middle_B /= static_cast<double>(out.middles_B.size());
  return out;
}

std::optional<SolidBridge> BridgeSearch::narrowest(const CarvedField& field,
                                                   const LoosePieces& hangs, const Vec3& p_B,
                                                   double around_m, double most_m2) {
  take_left(field);
  label();
  const Vec3 middle = (p_B - grid_.lo) / grid_.cell_m;
  const double around = around_m / grid_.cell_m;
  std::array<int, 3> lo{}, hi{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double c = middle[static_cast<Eigen::Index>(k)];
    lo[k] = static_cast<int>(std::clamp(c - around, 0.0, static_cast<double>(n_[k])));
    hi[k] = static_cast<int>(std::clamp(c + around + 1, 0.0, static_cast<double>(n_[k])));
  }
  bool here = false;
  for (int z = lo[2]; z < hi[2]; ++z)
    for (int y = lo[1]; y < hi[1]; ++y)
      for (int x = lo[0]; x < hi[0]; ++x) {
        const std::int32_t p = part_[at(x, y, z)];
        if (p < 0 || (Vec3(x, y, z) - middle).norm() > around) continue;
        source_[static_cast<std::size_t>(p)] = 1;
        here = true;
      }
  if (!here) return {};
  for (const LoosePieces::Held& held : hangs.held()) {
    const auto place = grid_.place(held.block);
    const int i = held.node;
    const std::int32_t p =
        part_[at(8 * place[0] + i % 8, 8 * place[1] + i / 8 % 8, 8 * place[2] + i / 64)];
    if (p < 0) continue;
    if (source_[static_cast<std::size_t>(p)]) return {};
    sink_[static_cast<std::size_t>(p)] = 1;
  }
  link();
  flow_ = 0;
  const double most = most_m2 / (grid_.cell_m * grid_.cell_m);
  while (push_more())
    if (flow_ > most) return {};
  if (flow_ == 0) return {};
  return bridge();
}

}  // namespace osteon
