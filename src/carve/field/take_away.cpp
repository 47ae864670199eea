// A loose piece is cut away: its nodes, and the distances around it.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "osteon/carve/loose_pieces.h"

namespace osteon {
namespace {

constexpr double kStillCells = 2;     // so near to what is left no cut changes: its surface stays
constexpr double kKnownCells = 2.5;   // distances to cuts are written so far out, see cut.cpp
constexpr double kSurelyCells = 0.5;  // a distance is wrong by more than what the search is
constexpr std::size_t kMostNodes = std::size_t{1} << 24;
constexpr double kFarAway_um = 1e18;
constexpr std::uint32_t kNowhere = 0xffffffffu;

}  // namespace

/// The nodes about a piece, and how far each is from what is left: every node learns from its
/// neighbours which node of the remaining bone's rim is nearest (Danielsson, Euclidean Distance
/// Mapping, 1980; off by less than half a cell). It ends because a distance only falls, and each is
/// one of finitely many.
struct LoosePieces::Local {
  const CarvedField& field;
  const BlockGrid& grid;
  double reach_um, cell_um;
  std::array<int, 3> lo{}, size{};
  std::vector<std::int16_t> level;    ///< um over what is left; negative: bone
  std::vector<std::int16_t> outside;  ///< um over the uncut bone
  std::vector<std::uint8_t> loose;
  std::vector<double> to_left_um;  ///< to the surface of what is left, kFarAway_um beyond the reach
  std::vector<double> to_piece_um;  ///< to that of the piece, likewise

  Local(const CarvedField& f, const LoosePiece& of, double reach_m)
      : field(f), grid(f.grid()), reach_um(1e6 * reach_m), cell_um(1e6 * f.grid().cell_m) {
    const int room = static_cast<int>(std::ceil(reach_m / grid.cell_m + kKnownCells)) + 1;
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::max(0, of.first[a] - room);
      const int hi = std::min(BlockGrid::kSide * grid.blocks[a] - 1, of.last[a] + room);
      size[a] = hi - lo[a] + 1;
    }
  }
  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  using Place = std::array<int, 3>;
  Place place(std::size_t n) const {
    const int i = static_cast<int>(n);
    return {i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
  }
  /// Visits all nodes in their order with their places: x runs first.
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    std::size_t n = 0;
    Place at{};
    for (at[2] = 0; at[2] < size[2]; ++at[2])
      for (at[1] = 0; at[1] < size[1]; ++at[1])
        for (at[0] = 0; at[0] < size[0]; ++at[0]) visit(n++, at);
  }
  struct Node {
    std::uint32_t block = 0;
    std::size_t node = 0;
  };
  Node node_of(Place at) const {
    Place in{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto sum = static_cast<unsigned>(at[a] + lo[a]);
      in[a] = static_cast<int>(sum % BlockGrid::kSide);
      at[a] = static_cast<int>(sum / BlockGrid::kSide);
    }
    return {grid.index(at), static_cast<std::size_t>(64 * in[2] + 8 * in[1] + in[0])};
  }
  /// Visits the rows along x, each in stretches of one block: the first node, how many, and where
  /// in its block that one is.
  template <class Visit>
  void for_stretches(const Visit& visit) const {
    std::size_t n = 0;
    Place at{};
    for (at[2] = 0; at[2] < size[2]; ++at[2])
      for (at[1] = 0; at[1] < size[1]; ++at[1])
        for (at[0] = 0; at[0] < size[0];) {
          const int in = (at[0] + lo[0]) % BlockGrid::kSide;
          const int many = std::min(BlockGrid::kSide - in, size[0] - at[0]);
          visit(n, static_cast<std::size_t>(many), node_of(at));
          n += static_cast<std::size_t>(many);
          at[0] += many;
        }
  }
  void read(const LoosePieces& of, const LoosePiece& which);
  std::vector<double> ways_um(double most_um) const;
  template <class Visit>
  void for_neighbours(std::size_t n, const Place& at, const Visit& visit) const;
  bool stays(std::size_t n) const { return level[n] < 0 && loose[n] == 0; }
  template <class Source>
  std::vector<std::uint32_t> rim_of(const Source& is_source) const;
  template <class Source>
  std::vector<double> spread(const Source& is_source, double most_um) const;
  void measure();
  std::int16_t cut_at(std::size_t n, std::int16_t before) const;
};

void LoosePieces::Local::read(const LoosePieces& of, const LoosePiece& which) {
  constexpr std::int16_t kFar = UncutField::kFar;
  level.resize(count());
  outside.resize(count());
  loose.assign(count(), 0);
  const auto is_before = [](const LoosePiece::Part& part, std::uint32_t block) {
    return part.block < block;
  };
  for_stretches([&](std::size_t n, std::size_t many, const Node& at) {
    const std::int16_t* cuts = field.cuts(at.block);
    const std::int16_t* heights = cuts ? field.heights(at.block) : field.bone().stored(at.block);
    const bool deep = field.bone().place(at.block) == UncutField::Place::kDeep;
    for (std::size_t i = 0; i < many; ++i) {
      outside[n + i] =
          heights ? heights[at.node + i] : (deep ? static_cast<std::int16_t>(-kFar) : kFar);
      level[n + i] = std::max(outside[n + i], cuts ? static_cast<std::int16_t>(-cuts[at.node + i])
                                                   : std::int16_t(-kFar));
    }
    auto part = std::lower_bound(which.parts.begin(), which.parts.end(), at.block, is_before);
    for (; part != which.parts.end() && part->block == at.block; ++part)
      for (std::size_t i = 0; i < many; ++i)
        if (of.label_at(field, at.block, at.node + i) == part->label) loose[n + i] = 1;
  });
}

// To the surface beyond a node of the rim, which lies so deep under it: of each sum of squares of
// steps along the axes, as far as `most_um` may reach.
std::vector<double> LoosePieces::Local::ways_um(double most_um) const {
  const double most = (most_um + cell_um) / cell_um;
  std::vector<double> out;
  for (int sum = 0; sum <= most * most; ++sum) out.push_back(cell_um * std::sqrt(double(sum)));
  return out;
}

template <class Visit>
void LoosePieces::Local::for_neighbours(std::size_t n, const Place& at, const Visit& visit) const {
  const std::array<std::size_t, 3> step{
      1, static_cast<std::size_t>(size[0]),
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  for (std::size_t a = 0; a < 3; ++a) {
    if (at[a] > 0) visit(n - step[a], static_cast<int>(a), -1);
    if (at[a] + 1 < size[a]) visit(n + step[a], static_cast<int>(a), 1);
  }
}

template <class Source>
std::vector<std::uint32_t> LoosePieces::Local::rim_of(const Source& is_source) const {
  std::vector<std::uint32_t> out;
  for_nodes([&](std::size_t n, const Place& at) {
    if (!is_source(n)) return;
    bool rim = false;
    for_neighbours(n, at, [&](std::size_t m, int, int) { rim = rim || !is_source(m); });
    if (rim) out.push_back(static_cast<std::uint32_t>(n));
  });
  return out;
}

template <class Source>
std::vector<double> LoosePieces::Local::spread(const Source& is_source, double most_um) const {
  struct Reached {
    double um = kFarAway_um;
    std::uint32_t from = kNowhere, told = kNowhere;
  };
  std::vector<Reached> reached(count());
  std::vector<std::uint8_t> closed(count());
  for (std::size_t n = 0; n < closed.size(); ++n) closed[n] = is_source(n) || stays(n) ? 1 : 0;
  const std::vector<double> way_um = ways_um(most_um);
  std::vector<std::uint32_t> open = rim_of(is_source);
  for (const std::uint32_t n : open) reached[n].from = n;
  for (std::size_t next = 0; next < open.size(); ++next) {
    const std::uint32_t here = open[next], source = reached[here].from;
    // Who has told its neighbours of this source has nothing new for them.
    if (std::exchange(reached[here].told, source) == source) continue;
    const Place at = place(here), rim = place(source);
    const Place apart{at[0] - rim[0], at[1] - rim[1], at[2] - rim[2]};
    const int sum = apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2];
    const double depth_um = std::min(-static_cast<double>(level[source]), cell_um);
    for_neighbours(here, at, [&](std::size_t m, int axis, int step) {
      if (closed[m] != 0) return;
      const int there = sum + 2 * step * apart[static_cast<std::size_t>(axis)] + 1;
      if (there >= static_cast<int>(way_um.size())) return;
      const double now = way_um[static_cast<std::size_t>(there)] - depth_um;
      if (now > most_um || !(now < reached[m].um)) return;
      reached[m].um = now;
      reached[m].from = source;
      open.push_back(static_cast<std::uint32_t>(m));
    });
  }
  std::vector<double> to(count());
  std::transform(reached.begin(), reached.end(), to.begin(), [](const Reached& r) { return r.um; });
  return to;
}

void LoosePieces::Local::measure() {
  to_left_um = spread([this](std::size_t n) { return stays(n); }, reach_um);
  const double known = reach_um + kKnownCells * cell_um;
  to_piece_um = spread([this](std::size_t n) { return loose[n] != 0; }, known);
}

// The cut that a node gets instead of the one before. What is cut away is all that lies within the
// reach of the piece and not in what is left: the larger of both distances.
std::int16_t LoosePieces::Local::cut_at(std::size_t n, std::int16_t before) const {
  if (stays(n)) return before;
  const double to = std::min(reach_um, to_left_um[n]);
  const auto whole = [](double um) {
    return static_cast<std::int16_t>(std::clamp(std::round(um), -32767.0, 32767.0));
  };
  if (loose[n] != 0) return std::min(before, whole(std::min(-1.0, -to)));
  if (to_piece_um[n] == kFarAway_um || to <= kStillCells * cell_um) return before;
  const double shape = std::max(-to, to_piece_um[n] - reach_um);
  const bool known = -shape <= -before + kSurelyCells * cell_um;
  return known || shape > kKnownCells * cell_um ? before : std::min(before, whole(shape));
}

bool LoosePieces::take_away(CarvedField& field, const LoosePiece& piece, double reach_m) const {
  // Each of its blocks will hold cuts: without room for these nothing need be measured.
  std::size_t least = field.block_count();
  for (std::size_t n = 0; n < piece.parts.size(); ++n)
    if ((n == 0 || piece.parts[n].block != piece.parts[n - 1].block) &&
        !field.cuts(piece.parts[n].block))
      ++least;
  if (least > field.most_blocks()) return false;
  Local local(field, piece, reach_m);
  if (local.count() > kMostNodes) return false;
  local.read(*this, piece);
  local.measure();
  struct Change {
    std::uint32_t block;
    std::uint16_t node;
    std::int16_t cut;
    bool operator<(const Change& b) const {
      return std::pair(block, node) < std::pair(b.block, b.node);
    }
  };
  std::vector<Change> changes;
  local.for_nodes([&](std::size_t n, const Local::Place& place) {
    if (local.stays(n)) return;
    const Local::Node at = local.node_of(place);
    const std::int16_t* cuts = field.cuts(at.block);
    const std::int16_t before = cuts ? cuts[at.node] : CarvedField::kUncut;
    const std::int16_t now = local.cut_at(n, before);
    if (now != before) changes.push_back({at.block, static_cast<std::uint16_t>(at.node), now});
  });
  std::sort(changes.begin(), changes.end());
  std::size_t wanted = field.block_count();
  for (std::size_t n = 0; n < changes.size(); ++n)
    if ((n == 0 || changes[n].block != changes[n - 1].block) && !field.cuts(changes[n].block))
      ++wanted;
  if (wanted > field.most_blocks()) return false;
  const std::uint64_t step = field.step() + 1;
  std::array<std::int16_t, BlockGrid::kNodes> cut;
  for (std::size_t n = 0; n < changes.size();) {
    const std::uint32_t block = changes[n].block;
    const std::int16_t* cuts = field.cuts(block);
    cut.fill(CarvedField::kUncut);
    if (cuts) std::copy_n(cuts, cut.size(), cut.begin());
    for (; n < changes.size() && changes[n].block == block; ++n)
      cut[changes[n].node] = changes[n].cut;
    (void)field.apply(block, cut, step);  // air beyond what a field keeps stays unknown
  }
  return true;
}

// A node of the piece is inside even where a cut grazes it; what else is there is outside.
std::vector<std::int16_t> LoosePieces::heights_of(const CarvedField& field, const LoosePiece& piece,
                                                  const std::array<int, 3>& first,
                                                  const std::array<int, 3>& last,
                                                  int stride) const {
  Local local(field, piece, 0);
  if (local.count() > kMostNodes) return {};
  local.read(*this, piece);
  const auto beyond = static_cast<std::int16_t>(std::min(32767.0, local.cell_um));
  std::vector<std::int16_t> out;
  std::array<int, 3> at{};
  for (at[2] = first[2]; at[2] <= last[2]; at[2] += stride)
    for (at[1] = first[1]; at[1] <= last[1]; at[1] += stride)
      for (at[0] = first[0]; at[0] <= last[0]; at[0] += stride) {
        std::array<int, 3> in{};
        bool known = true;
        for (std::size_t a = 0; a < 3; ++a) {
          in[a] = at[a] - local.lo[a];
          known = known && in[a] >= 0 && in[a] < local.size[a];
        }
        if (!known) {
          out.push_back(beyond);
          continue;
        }
        const auto n =
            static_cast<std::size_t>((in[2] * local.size[1] + in[1]) * local.size[0] + in[0]);
        const std::int16_t level = local.level[n];
        if (local.loose[n] != 0)
          out.push_back(std::min<std::int16_t>(level, -1));
        else
          out.push_back(level < 0 ? beyond : std::max<std::int16_t>(level, 1));
      }
  return out;
}

}  // namespace osteon
