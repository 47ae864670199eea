#include "osteon/collide/cut_field.h"

#include <algorithm>
#include <cmath>

#include "cubic_spline.h"

namespace osteon {
namespace {

// Distances to cuts are written so far out, see src/carve/field/cut.cpp.
constexpr double kKnownCells = 2.5;

// The four nodes along an axis that decide a value: in which of two blocks, and where there.
struct Nodes4 {
  std::array<int, 2> block{};
  std::array<std::uint8_t, 4> side{};  // of `block`
  std::array<std::uint16_t, 4> node{};
  double t = 0;
  bool inside = false;

  Nodes4(double at, int blocks) {
    const double low = std::floor(at);
    t = at - low;
    inside = low >= 1 && low + 2 < CutField::kSide * blocks;
    if (!inside) return;
    const int first = static_cast<int>(low) - 1;
    block = {first / CutField::kSide, (first + 3) / CutField::kSide};
    for (int i = 0; i < 4; ++i) {
      const auto n = static_cast<std::size_t>(i);
      side[n] = (first + i) / CutField::kSide == block[0] ? 0 : 1;
      node[n] = static_cast<std::uint16_t>((first + i) % CutField::kSide);
    }
  }
};

using Corners = std::array<const std::int16_t*, 8>;  // of eight blocks, null where none is cut

// Cuts at 4 x 4 x 4 nodes, um, x fastest: of more than one block, so that they lie nowhere in rows.
using Nodes64 = std::array<std::int16_t, 64>;

void gather(const Corners& corner, const Nodes4& x, const Nodes4& y, const Nodes4& z,
            Nodes64& out) {
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      std::int16_t* row = out.data() + 16 * k + 4 * j;
      const std::size_t first = 64u * z.node[k] + 8u * y.node[j];
      const std::size_t blocks = 4u * z.side[k] + 2u * y.side[j];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::int16_t* from = corner[blocks + x.side[i]];
        row[i] = from ? from[first + x.node[i]] : CutField::kUncut;
      }
    }
}

// Rows within blocks, or of nodes that nothing has cut.
void find_rows(const Corners& corner, const Nodes4& x, const Nodes4& y, const Nodes4& z,
               SplineRows& out) {
  static constexpr std::array<std::int16_t, 4> kNothing{CutField::kUncut, CutField::kUncut,
                                                        CutField::kUncut, CutField::kUncut};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::int16_t* from = corner[4u * z.side[k] + 2u * y.side[j]];
      const std::size_t first = 64u * z.node[k] + 8u * y.node[j] + x.node[0];
      out.row[4 * k + j] = from ? from + first : kNothing.data();
    }
}

}  // namespace

CutField::CutField(const CutGrid& grid, std::size_t most_blocks, double slack_m)
    : grid_(grid),
      slack_m_(slack_m),
      farthest_um_(std::min(std::round(1e6 * kKnownCells * grid.cell_m), double{kUncut})),
      slot_(grid.count(), kNone),
      block_of_(most_blocks, kNone),
      nodes_(most_blocks) {}

bool CutField::set(std::uint32_t block, Block cut) {
  if (block >= slot_.size() || (slot_[block] == kNone && used_ == nodes_.size())) return false;
  ++changes_;
  if (slot_[block] == kNone) {
    slot_[block] = static_cast<std::uint32_t>(used_);
    block_of_[used_++] = block;
  }
  std::copy(cut.begin(), cut.end(), nodes_[slot_[block]].begin());
  return true;
}

void CutField::clear() {
  ++changes_;
  for (std::size_t n = 0; n < used_; ++n) slot_[block_of_[n]] = kNone;
  used_ = 0;
}

// The cuts about a place, and where it is in its cell.
struct CutField::Around {
  SplineRows rows;
  Vec3 t;
  Nodes64 um;  // what rows of more than one block are gathered in
};

bool CutField::find(const Vec3& p_B, Around& out) const {
  const Vec3 u = (p_B - grid_.lo) / grid_.cell_m;
  if (!is_finite(u)) return false;
  const Nodes4 x(u.x(), grid_.blocks[0]), y(u.y(), grid_.blocks[1]), z(u.z(), grid_.blocks[2]);
  if (!x.inside || !y.inside || !z.inside) return false;
  Corners corner{};
  bool any = false;
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const int at = (z.block[c >> 2] * grid_.blocks[1] + y.block[c >> 1 & 1]) * grid_.blocks[0] +
                   x.block[c & 1];
    const std::uint32_t slot = slot_[static_cast<std::size_t>(at)];
    if (slot == kNone) continue;
    corner[c] = nodes_[slot].data();
    any = true;
  }
  if (!any) return false;
  out.rows.most = static_cast<std::int16_t>(farthest_um_);
  out.t = {x.t, y.t, z.t};
  if (x.side[3] == 0) {
    find_rows(corner, x, y, z, out.rows);
    return true;
  }
  gather(corner, x, y, z, out.um);
  for (std::size_t i = 0; i < out.rows.row.size(); ++i) out.rows.row[i] = out.um.data() + 4 * i;
  return true;
}

bool CutField::height(const Vec3& p_B, FieldSample& out) const {
  Around around;
  if (!find(p_B, around)) return false;
  const SplineSum found = sum_splines(around.rows, around.t);
  out.distance = slack_m_ - 1e-6 * found.value;
  out.gradient = -1e-6 / grid_.cell_m * found.slope;
  out.near = found.value < farthest_um_;
  return true;
}

bool CutField::distance(const Vec3& p_B, double& out) const {
  Around around;
  if (!find(p_B, around)) return false;
  out = slack_m_ - 1e-6 * value_of_splines(around.rows, around.t);
  return true;
}

}  // namespace osteon
