// One step of carving.
#include <cmath>
#include <limits>

#include "field/cut_rows.h"
#include "osteon/carve/carved_field.h"

namespace osteon {
namespace {

// A node next to one that the surface passes must be right too: two cells along an axis, and some.
constexpr double kReachCells = 2.5;
constexpr double kPlacesApart = 0.5;  // cells
constexpr double kMostPlaces = 2048;  // of a part in one step

// The turn lies between 0 and pi: no more than this times the quaternions' distance.
constexpr double kTurnOfChord = 2.2215;

double turn_bound(const Quat& a, const Quat& b) {
  const double minus = (a.coeffs() - b.coeffs()).norm(), plus = (a.coeffs() + b.coeffs()).norm();
  return kTurnOfChord * std::min(minus, plus);
}

// No point of the part goes farther than this.
double longest_way(const CutterPart& part, const Pose& a, const Pose& b) {
  const double reach = part.box.lo.cwiseAbs().cwiseMax(part.box.hi.cwiseAbs()).norm();
  return (b.p - a.p).norm() + reach * turn_bound(a.q, b.q);
}

Pose between(const Pose& a, const Pose& b, double t) {
  const double sign = a.q.coeffs().dot(b.q.coeffs()) < 0 ? -1 : 1;
  Pose out;
  out.p = a.p + t * (b.p - a.p);
  out.q.coeffs() = (1 - t) * a.q.coeffs() + (sign * t) * b.q.coeffs();
  out.q.normalize();
  return out;
}

std::int32_t whole_um(double m) { return static_cast<std::int32_t>(std::round(1e6 * m)); }

// First and last block that nodes within `reach` of a box may belong to.
struct BlockBox {
  std::array<int, 3> lo{}, hi{};       // blocks
  std::array<int, 3> first{}, last{};  // nodes
  bool empty = false;
};

BlockBox blocks_of(const BlockGrid& grid, const Aabb& box, double reach) {
  BlockBox out;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double most = 8.0 * grid.blocks[a] - 1;
    const double lo = std::ceil((box.lo[axis] - reach - grid.lo[axis]) / grid.cell_m);
    const double hi = std::floor((box.hi[axis] + reach - grid.lo[axis]) / grid.cell_m);
    if (!(hi >= 0 && lo <= most && lo <= hi)) {
      out.empty = true;
      return out;
    }
    out.first[a] = static_cast<int>(std::max(lo, 0.0));
    out.last[a] = static_cast<int>(std::min(hi, most));
    out.lo[a] = out.first[a] / BlockGrid::kSide;
    out.hi[a] = out.last[a] / BlockGrid::kSide;
  }
  return out;
}

BlockRows rows_in(const BlockBox& box, const std::array<int, 3>& at) {
  const auto low = [&](std::size_t a) { return std::max(0, box.first[a] - 8 * at[a]); };
  const auto high = [&](std::size_t a) { return std::min(7, box.last[a] - 8 * at[a]); };
  return {low(1), high(1), low(2), high(2)};
}

}  // namespace

// Two passes over the same places and blocks: the first only marks the blocks that are to be taken,
// so that a step which does not fit leaves all as it was.
struct CarvedField::Pass {
  CarvedField& field;
  CutScale scale;
  double reach_m;
  CarveStep result = {};
  std::array<std::int64_t, kMostBoneLayers> removed{};
  std::int64_t cartilage = 0;
  alignas(64) std::array<float, BlockGrid::kNodes> distance;

  explicit Pass(CarvedField& f) : field(f), reach_m(kReachCells * f.grid().cell_m) {
    scale.cell = whole_um(f.grid().cell_m);
    scale.reach = whole_um(reach_m);
    scale.layer = f.layer_um_;
    scale.layers = f.layers_.layers.size();
  }

  // Blocks with bone that a placed part may reach, and in whose slots `looks_at` is interested.
  template <class LooksAt, class Visit>
  void for_blocks(const PlacedPart& placed, const LooksAt& looks_at, const Visit& visit) {
    const BlockGrid& grid = field.grid();
    const BlockBox box = blocks_of(grid, placed.box(), reach_m);
    const bool ball = placed.is_ball();
    if (box.empty) return;
    for (int k = box.lo[2]; k <= box.hi[2]; ++k)
      for (int j = box.lo[1]; j <= box.hi[1]; ++j)
        for (int i = box.lo[0]; i <= box.hi[0]; ++i) {
          const std::array<int, 3> at{i, j, k};
          const std::uint32_t block = grid.index(at);
          if (!looks_at(field.slot_[block]) || !field.may_hold_cuts(block)) continue;
          if (placed.at_least(grid.middle(at)) > reach_m + grid.reach_m()) continue;
          const BlockRows all = rows_in(box, at);
          if (!ball) {
            visit(block, at, all);
            continue;
          }
          const Vec3 lo = grid.node(8 * at[0], 8 * at[1], 8 * at[2]);
          const BlockRows rows = near_ball(placed, lo, grid.cell_m, reach_m, all);
          if (rows.asked != 0) visit(block, at, rows);
        }
  }

  // Places of the part from one pose to the next; all of a ball's way at once.
  template <class Visit>
  void for_places(const CutterPart& part, const Pose& a, const Pose& b, const Visit& visit) {
    if (PlacedPart::is_ball(part)) {
      const Vec3 start = a * part.rods[0].p0, end = b * part.rods[0].p0;
      return visit(PlacedPart{&part, {start - b.rotate(part.rods[0].p0), b.q}, end - start});
    }
    const int steps =
        static_cast<int>(std::ceil(longest_way(part, a, b) / (kPlacesApart * field.grid().cell_m)));
    for (int n = 0; n <= steps; ++n)
      visit(PlacedPart{&part, steps == 0 ? b : between(a, b, double(n) / steps), Vec3::Zero()});
  }

  bool too_long(const CutterPart& part, const Pose& a, const Pose& b) const {
    if (PlacedPart::is_ball(part)) return false;
    return longest_way(part, a, b) > kMostPlaces * kPlacesApart * field.grid().cell_m;
  }

  // Marks the blocks to be taken, and counts them; gives up where there are not so many left.
  bool mark_wanted(const Cutter& cutter, const Pose& a, const Pose& b) {
    const std::size_t left = field.marks_.size() - field.used_;
    std::size_t wanted = 0;
    for_all(cutter, a, b, [&](const PlacedPart& placed) {
      if (wanted > left) return;
      const auto is_new = [](std::uint32_t slot) { return slot == kNone; };
      for_blocks(placed, is_new, [&](std::uint32_t block, const auto& at, const BlockRows& rows) {
        measure(placed, at, rows);
        if (!reaches(distance.data(), scale, rows)) return;
        field.slot_[block] = kWanted;
        ++wanted;
      });
    });
    return wanted <= left;
  }

  void unmark(const Cutter& cutter, const Pose& a, const Pose& b) {
    for_all(cutter, a, b, [&](const PlacedPart& placed) {
      const auto is_wanted = [](std::uint32_t slot) { return slot == kWanted; };
      for_blocks(placed, is_wanted, [&](std::uint32_t block, const auto&, const BlockRows&) {
        field.slot_[block] = kNone;
      });
    });
  }

  template <class Visit>
  void for_all(const Cutter& cutter, const Pose& a, const Pose& b, const Visit& visit) {
    for (const CutterPart& part : cutter.parts) for_places(part, a, b, visit);
  }

  void measure(const PlacedPart& placed, const std::array<int, 3>& at, const BlockRows& rows) {
    const Vec3 lo = field.grid().node(8 * at[0], 8 * at[1], 8 * at[2]);
    part_distances(placed, lo, field.grid().cell_m, rows, distance.data());
  }

  void remove(const PlacedPart& placed) {
    const auto is_taken = [](std::uint32_t slot) { return slot != kNone; };
    for_blocks(placed, is_taken, [&](std::uint32_t block, const auto& at, const BlockRows& rows) {
      std::uint32_t slot = field.slot_[block];
      measure(placed, at, rows);
      if (slot == kWanted) slot = field.take(block);
      Nodes& nodes = field.nodes_[slot];
      const std::int16_t* all = nodes.height.data();
      const std::int16_t* bare = field.bare_.empty() ? all : field.bare_[slot].data();
      note(slot, lower_cuts(distance.data(), scale, rows, {all, bare}, nodes.cut.data()));
    });
  }

  void note(std::uint32_t slot, const Lowered& lowered) {
    if (!lowered.any) return;
    Mark& mark = field.marks_[slot];
    if (mark.changed != field.step_) ++result.blocks;
    mark.changed = field.step_;
    mark.hashed = false;
    if (!lowered.near) return;
    mark.surface = field.step_;
    for (std::size_t s = 0; s < 6; ++s)
      if ((lowered.sides >> s & 1) != 0) mark.side[s] = field.step_;
    for (std::size_t l = 0; l < scale.layers; ++l) removed[l] += lowered.removed[l];
    cartilage += lowered.cartilage;
  }

  // Layer by layer: what lies from one on, less what lies from the next on.
  void count_removed() {
    const double share = static_cast<double>(scale.cell) * static_cast<double>(scale.cell);
    const double cell3 = std::pow(field.grid().cell_m, 3);
    result.removed_m3[static_cast<std::size_t>(BoneTissue::kCartilage)] +=
        static_cast<double>(cartilage) / share * cell3;
    if (cartilage > 0) result.status |= CarveStep::kRemoved;
    for (std::size_t l = 0; l < scale.layers; ++l) {
      const std::int64_t here = removed[l] - (l + 1 < scale.layers ? removed[l + 1] : 0);
      const auto tissue = static_cast<std::size_t>(field.layers_.layers[l].tissue);
      result.removed_m3[tissue] += static_cast<double>(here) / share * cell3;
      if (here > 0) result.status |= CarveStep::kRemoved;
    }
  }
};

CarveStep CarvedField::cut(const Cutter& cutter, const Pose& X_BT0, const Pose& X_BT1) {
  ++step_;
  CarveStep refused;
  if (!is_finite(X_BT0) || !is_finite(X_BT1) || !cutter.finite()) {
    refused.status = CarveStep::kNotFinite;
    return refused;
  }
  Pass pass(*this);
  for (const CutterPart& part : cutter.parts)
    if (pass.too_long(part, X_BT0, X_BT1)) refused.status |= CarveStep::kTooLong;
  if (refused.status != 0) return refused;
  if (!pass.mark_wanted(cutter, X_BT0, X_BT1)) {
    pass.unmark(cutter, X_BT0, X_BT1);
    refused.status = CarveStep::kBlocksFull;
    return refused;
  }
  pass.for_all(cutter, X_BT0, X_BT1, [&](const PlacedPart& placed) { pass.remove(placed); });
  pass.count_removed();
  return pass.result;
}

}  // namespace osteon
