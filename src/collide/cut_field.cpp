#include "osteon/collide/cut_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "cubic_spline.h"

namespace osteon {
namespace {

// Distances to cuts are written so far out, see src/carve/field/cut.cpp.
constexpr double kKnownCells = 2.5;

// The four nodes along an axis that decide a value: in which of two blocks, and where there.
struct Nodes4 {
  static constexpr unsigned kSide = CutField::kSide;
  std::array<unsigned, 2> block{};     // of the first and the last of them
  std::array<unsigned, 4> node{};      // in its block
  std::array<std::uint8_t, 4> side{};  // of `block`
  double t = 0;
  bool inside = false;

  // What is not a number is not inside.
  Nodes4(double at, int blocks) {
    inside = at >= 1 && at < CutField::kSide * blocks - 2;
    if (!inside) return;
    const auto low = static_cast<unsigned>(at);
    t = at - low;
    const unsigned first = low - 1;
    block = {first / kSide, (first + 3) / kSide};
    for (unsigned i = 0; i < 4; ++i) {
      node[i] = (first + i) % kSide;
      side[i] = first % kSide + i < kSide ? 0 : 1;
    }
  }
  bool in_one_block() const { return side[3] == 0; }
};

using Corners = std::array<const std::int16_t*, 8>;  // of eight blocks, null where none is cut

// Cuts at 4 x 4 x 4 nodes, um, x fastest: of more than one block, so that they lie nowhere in rows.
using Nodes64 = std::array<std::int16_t, 64>;
constexpr std::size_t kAlong = CutField::kSide;
constexpr std::array<std::int16_t, kAlong> kNothing{
    CutField::kUncut, CutField::kUncut, CutField::kUncut, CutField::kUncut,
    CutField::kUncut, CutField::kUncut, CutField::kUncut, CutField::kUncut};

// The block's row along x of that place, or one of nodes that nothing has cut.
const std::int16_t* row_of(const Corners& corner, std::size_t side, unsigned y, unsigned z) {
  const std::int16_t* block = corner[side];
  return block ? block + kAlong * (kAlong * z + y) : kNothing.data();
}

std::uint64_t four_from(const std::int16_t* first) {
  std::uint64_t four = 0;
  std::memcpy(&four, first, sizeof four);
  return four;
}

// Of each row the last nodes of one block and the first ones of the next: four of each are loaded
// as one number, so that those that are not wanted are shifted out.
void gather(const Corners& corner, const Nodes4& x, const Nodes4& y, const Nodes4& z,
            Nodes64& out) {
  constexpr unsigned kHalf = CutField::kSide / 2;
  const unsigned gone = 16 * (x.node[0] - kHalf), kept = 64 - gone;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t side = 4u * z.side[k] + 2u * y.side[j];
      const std::uint64_t low = four_from(row_of(corner, side, y.node[j], z.node[k]) + kHalf);
      const std::uint64_t high = four_from(row_of(corner, side + 1, y.node[j], z.node[k]));
      constexpr bool kLittle = std::endian::native == std::endian::little;
      const std::uint64_t four =
          kLittle ? (low >> gone) | (high << kept) : (low << gone) | (high >> kept);
      std::memcpy(out.data() + 16 * k + 4 * j, &four, sizeof four);
    }
}

// Rows within blocks, or of nodes that nothing has cut.
void find_rows(const Corners& corner, const Nodes4& x, const Nodes4& y, const Nodes4& z,
               SplineRows& out) {
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j)
      out.row[4 * k + j] =
          row_of(corner, 4u * z.side[k] + 2u * y.side[j], y.node[j], z.node[k]) + x.node[0];
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
  const auto blocks_x = static_cast<std::size_t>(grid_.blocks[0]);
  const auto blocks_y = static_cast<std::size_t>(grid_.blocks[1]);
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const std::size_t from_x = c & 1, from_y = c >> 1 & 1, from_z = c >> 2;
    if (from_x > x.side[3] || from_y > y.side[3] || from_z > z.side[3]) continue;
    const std::size_t at =
        (z.block[from_z] * blocks_y + y.block[from_y]) * blocks_x + x.block[from_x];
    const std::uint32_t slot = slot_[at];
    if (slot == kNone) continue;
    corner[c] = nodes_[slot].data();
    any = true;
  }
  if (!any) return false;
  out.rows.most = static_cast<std::int16_t>(farthest_um_);
  out.t = {x.t, y.t, z.t};
  if (x.in_one_block()) {
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
