#include "soft/solid_bridge.h"

#include <algorithm>
#include <array>
#include <limits>

namespace osteon {
namespace {

constexpr int kBridgeCube = 2;
constexpr std::int32_t kNoLink = -1;

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
  rows_.assign(static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]), {n_[0], 0});
  std::array<std::int16_t, BlockGrid::kNodes> heights{};
  for (std::uint32_t b = 0; b < grid_.count(); ++b) {
    field.bone().heights(b, heights);
    const auto place = grid_.place(b);
    for (int i = 0; i < static_cast<int>(BlockGrid::kNodes); ++i)
      inside_[at(8 * place[0] + i % 8, 8 * place[1] + i / 8 % 8, 8 * place[2] + i / 64)] =
          heights[static_cast<std::size_t>(i)] < 0 ? 1 : 0;
  }
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x)
        if (inside_[at(x, y, z)]) {
          Row& row = row_at(y, z);
          row.from = std::min(row.from, x);
          row.to = x + 1;
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
void BridgeSearch::label(int z) {
  std::array<std::array<int, 3>, kBridgeCube * kBridgeCube * kBridgeCube> stack{};
  const auto flood = [&](int x, int y) {
    std::size_t count = 0;
    stack[count++] = {x, y, z};
    part_[at(x, y, z)] = parts_;
    while (count > 0) {
      const std::array<int, 3> p = stack[--count];
      for (std::size_t k = 0; k < 3; ++k)
        for (const int step : {-1, 1}) {
          std::array<int, 3> q = p;
          q[k] += step;
          if (q[k] < 0 || q[k] >= n_[k] || q[k] / kBridgeCube != p[k] / kBridgeCube) continue;
          const std::size_t i = at(q[0], q[1], q[2]);
          if (!left_[i] || part_[i] >= 0) continue;
          part_[i] = parts_;
          stack[count++] = q;
        }
    }
    ++parts_;
  };
  for (int y = 0; y < n_[1]; ++y)
    for (int x = row_at(y, z).from; x < row_at(y, z).to; ++x)
      if (const std::size_t i = at(x, y, z); left_[i] && part_[i] < 0) flood(x, y);
}

// Pairs of nodes of one layer and the next whose parts meet.
template <class Visit>
void BridgeSearch::each_pair(int z, const Visit& visit) const {
  const std::array<std::size_t, 3> stride = {
      1, static_cast<std::size_t>(n_[0]),
      static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1])};
  for (int y = 0; y < n_[1]; ++y)
    for (int x = row_at(y, z).from; x < row_at(y, z).to; ++x) {
      const std::size_t i = at(x, y, z);
      const std::array<int, 3> p = {x, y, z};
      for (std::size_t k = 0; k < 3 && part_[i] >= 0; ++k) {
        if ((p[k] + 1) % kBridgeCube != 0 || p[k] + 1 >= n_[k]) continue;
        if (const std::int32_t b = part_[i + stride[k]]; b >= 0) visit(part_[i], b);
      }
    }
}

void BridgeSearch::begin_links() {
  const auto parts = static_cast<std::size_t>(parts_);
  for (std::size_t p = 0; p < parts; ++p) begin_[p + 1] += begin_[p];
  met_.resize(static_cast<std::size_t>(begin_[parts]));
  next_.assign(begin_.begin(), begin_.begin() + parts_);
  links_.clear();
  first_.assign(1, 0);
}

// Of two parts that meet, as much room either way as they have pairs of nodes.
void BridgeSearch::link(std::size_t p) {
  const auto from = met_.begin() + begin_[p], end = met_.begin() + begin_[p + 1];
  std::sort(from, end);
  for (auto it = from; it != end;) {
    const auto beyond = std::upper_bound(it, end, *it);
    links_.push_back({*it, static_cast<std::int32_t>(beyond - it)});
    it = beyond;
  }
  first_.push_back(static_cast<std::int32_t>(links_.size()));
}

void BridgeSearch::link_back(std::size_t p) {
  for (std::int32_t l = first_[p]; l < first_[p + 1]; ++l) {
    const auto to = static_cast<std::size_t>(links_[static_cast<std::size_t>(l)].to);
    const auto from = links_.begin() + first_[to], end = links_.begin() + first_[to + 1];
    const auto same =
        std::lower_bound(from, end, static_cast<std::int32_t>(p),
                         [](const Link& link, std::int32_t part) { return link.to < part; });
    back_[static_cast<std::size_t>(l)] = static_cast<std::int32_t>(same - links_.begin());
  }
}

// Layer by layer, then part by part. Ends: each piece of it goes on by one of these.
bool BridgeSearch::prepare(const CarvedField& field, std::size_t layers) {
  if (of_step_ != field.step()) {
    of_step_ = field.step();
    stage_ = Stage::kLeft;
  }
  const auto all_layers = static_cast<std::size_t>(n_[2]);
  for (std::size_t done = 0; stage_ != Stage::kReady && done < layers; ++done) {
    if (stage_ == Stage::kLeft) {
      take_left(field);
      part_.assign(left_.size(), -1);
      parts_ = 0;
      go_to(Stage::kLabel);
    } else if (stage_ == Stage::kLabel) {
      label(static_cast<int>(at_));
      if (++at_ < all_layers) continue;
      begin_.assign(static_cast<std::size_t>(parts_) + 1, 0);
      go_to(Stage::kCount);
    } else if (stage_ == Stage::kCount) {
      each_pair(static_cast<int>(at_), [&](std::int32_t a, std::int32_t b) {
        ++begin_[static_cast<std::size_t>(a) + 1];
        ++begin_[static_cast<std::size_t>(b) + 1];
      });
      if (++at_ < all_layers) continue;
      begin_links();
      go_to(Stage::kMeet);
    } else if (stage_ == Stage::kMeet) {
      each_pair(static_cast<int>(at_), [&](std::int32_t a, std::int32_t b) {
        met_[static_cast<std::size_t>(next_[static_cast<std::size_t>(a)]++)] = b;
        met_[static_cast<std::size_t>(next_[static_cast<std::size_t>(b)]++)] = a;
      });
      if (++at_ == all_layers) go_to(Stage::kLink);
    } else {
      const auto parts = static_cast<std::size_t>(parts_);
      const std::size_t end = std::min(parts, at_ + parts / all_layers + 1);
      const bool back = stage_ == Stage::kBack;
      for (; at_ < end; ++at_) back ? link_back(at_) : link(at_);
      if (at_ < parts) continue;
      if (!back) back_.assign(links_.size(), kNoLink);
      go_to(back ? Stage::kReady : Stage::kBack);
    }
  }
  return stage_ == Stage::kReady;
}

void BridgeSearch::go_to(Stage stage) {
  stage_ = stage;
  at_ = 0;
}

// How many links each part is from the place, along links with room. False: no part that is held
// can be reached.
bool BridgeSearch::find_levels() {
  level_.assign(source_.size(), -1);
  queue_.clear();
  for (std::size_t p = 0; p < source_.size(); ++p)
    if (source_[p]) {
      level_[p] = 0;
      queue_.push_back(static_cast<std::int32_t>(p));
    }
  std::int32_t held_at = -1;
  for (std::size_t n = 0; n < queue_.size(); ++n) {
    const auto p = static_cast<std::size_t>(queue_[n]);
    if (held_at >= 0 && level_[p] >= held_at) break;
    for (std::int32_t l = first_[p]; l < first_[p + 1]; ++l) {
      const auto to = static_cast<std::size_t>(links_[static_cast<std::size_t>(l)].to);
      if (room_[static_cast<std::size_t>(l)] <= 0 || level_[to] >= 0) continue;
      level_[to] = level_[p] + 1;
      if (sink_[to]) held_at = level_[to];
      queue_.push_back(static_cast<std::int32_t>(to));
    }
  }
  return held_at >= 0;
}

// Symbols: a part is a node of the graph, a link's room the pairs of nodes that no way uses yet.
// Invariant: what flows into a part flows out of it, but where it starts and where it is held.
// Source: Dinic, Soviet Math. Doklady 11 (1970). Ends: in each round ways lead away from the place
// alone, each fills a link or leaves one for good, and from round to round the shortest way gets
// longer. False: there is no way, and what was reached is parted from the rest by the least cut:
// that of all least cuts which is nearest to the place, in whatever order ways were found.
bool BridgeSearch::push_more() {
  if (!find_levels()) return false;
  next_.assign(first_.begin(), first_.end() - 1);
  for (std::size_t s = 0; s < source_.size(); ++s) {
    if (!source_[s]) continue;
    way_.clear();
    for (std::size_t p = s;;) {
      if (sink_[p]) {
        std::int32_t room = std::numeric_limits<std::int32_t>::max();
        for (const std::int32_t l : way_) room = std::min(room, room_[static_cast<std::size_t>(l)]);
        for (const std::int32_t l : way_) {
          room_[static_cast<std::size_t>(l)] -= room;
          room_[static_cast<std::size_t>(back_[static_cast<std::size_t>(l)])] += room;
        }
        flow_ += room;
        way_.clear();
        p = s;
        continue;
      }
      std::int32_t& l = next_[p];
      while (l < first_[p + 1] &&
             (room_[static_cast<std::size_t>(l)] <= 0 ||
              level_[static_cast<std::size_t>(links_[static_cast<std::size_t>(l)].to)] !=
                  level_[p] + 1))
        ++l;
      if (l < first_[p + 1]) {
        way_.push_back(l);
        p = static_cast<std::size_t>(links_[static_cast<std::size_t>(l)].to);
        continue;
      }
      if (way_.empty()) break;
      const auto last = static_cast<std::size_t>(way_.back());
      way_.pop_back();
      p = static_cast<std::size_t>(links_[static_cast<std::size_t>(back_[last])].to);
      ++next_[p];
    }
  }
  return true;
}

// What the last search reached is on the place's side.
SolidBridge BridgeSearch::bridge() const {
  SolidBridge out;
  out.area_m2 = flow_ * grid_.cell_m * grid_.cell_m;
  const auto reached = [&](std::int32_t p) { return level_[static_cast<std::size_t>(p)] >= 0; };
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = row_at(y, z).from; x < row_at(y, z).to; ++x) {
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
  while (!prepare(field, 1000)) {
  }
  source_.assign(static_cast<std::size_t>(parts_), 0);
  sink_.assign(static_cast<std::size_t>(parts_), 0);
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
  room_.resize(links_.size());
  for (std::size_t l = 0; l < links_.size(); ++l) room_[l] = links_[l].room;
  flow_ = 0;
  const double most = most_m2 / (grid_.cell_m * grid_.cell_m);
  while (push_more())
    if (flow_ > most) return {};
  if (flow_ == 0) return {};
  return bridge();
}

}  // namespace osteon
