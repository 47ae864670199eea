#include "osteon/collide/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cubic_spline.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace {

// The heights about a cell of a block.
SplineRows rows_from(const std::int16_t* first) {
  constexpr std::size_t kRow = FieldData::kSpan;
  SplineRows rows;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) rows.row[4 * k + j] = first + (k * kRow + j) * kRow;
  return rows;
}

bool fits(const FieldData& d) {
  std::size_t blocks = 1;
  for (const std::int32_t n : d.blocks) {
    if (n < 1 || n > 4096) return false;
    blocks *= static_cast<std::size_t>(n);
  }
  const bool sized = std::isfinite(d.cell_m) && d.cell_m > 0 && std::isfinite(d.step_m) &&
                     d.step_m > 0 && std::isfinite(d.outside_m) && d.outside_m > 0 &&
                     std::isfinite(d.inside_m) && d.inside_m > 0;
  if (!sized || !is_finite(d.lo) || !is_finite(d.box.lo) || !is_finite(d.box.hi) || d.box.empty())
    return false;
  if (d.middle.size() != blocks || d.stored.size() != blocks) return false;
  if (d.height.size() % FieldData::kBlock != 0) return false;
  const std::size_t count = d.height.size() / FieldData::kBlock;
  const bool places = std::all_of(d.stored.begin(), d.stored.end(), [count](std::uint32_t s) {
    return s == FieldData::kNone || s < count;
  });
  return places &&
         std::all_of(d.middle.begin(), d.middle.end(), [](float m) { return std::isfinite(m); });
}

std::uint64_t hash_of(const FieldData& d) {
  Hasher hasher;
  for (const double x : {d.cell_m, d.step_m, d.outside_m, d.inside_m}) hasher.add(x);
  hasher.add(d.box.lo);
  hasher.add(d.box.hi);
  hasher.add(d.lo);
  for (const std::int32_t n : d.blocks) hasher.add(n);
  hasher.bytes(d.middle.data(), d.middle.size() * sizeof(float));
  hasher.bytes(d.stored.data(), d.stored.size() * sizeof(std::uint32_t));
  hasher.bytes(d.height.data(), d.height.size() * sizeof(std::int16_t));
  return hasher.value();
}

}  // namespace

DistanceField::DistanceField(FieldData data) : data_(std::move(data)), hash_(hash_of(data_)) {}

std::shared_ptr<const DistanceField> DistanceField::from(FieldData data) {
  if (!fits(data)) return nullptr;
  return std::shared_ptr<const DistanceField>(new DistanceField(std::move(data)));
}

std::size_t DistanceField::bytes() const {
  return data_.middle.size() * sizeof(float) + data_.stored.size() * sizeof(std::uint32_t) +
         data_.height.size() * sizeof(std::int16_t);
}

std::size_t DistanceField::index_of(const std::array<int, 3>& block) const {
  return static_cast<std::size_t>((block[2] * data_.blocks[1] + block[1]) * data_.blocks[0] +
                                  block[0]);
}

// A point in the grid: its block, the first height of its cell, and where it is in the cell.
struct DistanceField::Spot {
  std::array<int, 3> block{};
  const std::int16_t* first = nullptr;  // null: the block is not stored
  Vec3 t;
};

bool DistanceField::find(const Vec3& p_B, Spot& out) const {
  const Vec3 u = (p_B - data_.lo) / data_.cell_m;
  std::array<std::size_t, 3> cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    if (!(u[axis] >= 0 && u[axis] < FieldData::kSide * data_.blocks[k])) return false;
    const int i = static_cast<int>(u[axis]);
    out.t[axis] = u[axis] - i;
    out.block[k] = i / FieldData::kSide;
    cell[k] = static_cast<std::size_t>(i % FieldData::kSide);
  }
  const std::uint32_t stored = data_.stored[index_of(out.block)];
  if (stored == FieldData::kNone) return true;
  constexpr std::size_t kRow = FieldData::kSpan;
  const std::size_t first = (cell[2] * kRow + cell[1]) * kRow + cell[0];
  out.first = data_.height.data() + stored * FieldData::kBlock + first;
  return true;
}

FieldSample DistanceField::at(const Vec3& p_B) const {
  if (!is_finite(p_B)) return {std::numeric_limits<double>::quiet_NaN(), Vec3::Zero(), false};
  Spot spot;
  if (!find(p_B, spot)) return beyond_grid(p_B);
  if (!spot.first) return in_far_block(spot.block, p_B);
  const SplineSum local = sum_splines(rows_from(spot.first), spot.t);
  const double distance = data_.step_m * local.value;
  const bool near = distance <= data_.outside_m && distance >= -data_.inside_m;
  // A stored block reaches out of the band: there its heights are bounds too, being cut off.
  return {distance, (data_.step_m / data_.cell_m) * local.slope, near};
}

double DistanceField::distance_at(const Vec3& p_B) const {
  if (!is_finite(p_B)) return std::numeric_limits<double>::quiet_NaN();
  Spot spot;
  if (!find(p_B, spot)) return beyond_grid(p_B).distance;
  if (!spot.first) return bound_in(spot.block, p_B);
  return data_.step_m * value_of_splines(rows_from(spot.first), spot.t);
}

FieldSample DistanceField::beyond_grid(const Vec3& p) const {
  const Vec3 away = p - p.cwiseMax(data_.box.lo).cwiseMin(data_.box.hi);
  const double distance = away.norm();
  return {distance, distance > 0 ? Vec3(away / distance) : Vec3(Vec3::UnitZ()), false};
}

// The exact height of the block's middle less the way to there; and no less than the band.
double DistanceField::bound_in(const std::array<int, 3>& block, const Vec3& p) const {
  const double side = FieldData::kSide * data_.cell_m;
  const Vec3 middle = data_.lo + side * Vec3(block[0] + 0.5, block[1] + 0.5, block[2] + 0.5);
  const double height = static_cast<double>(data_.middle[index_of(block)]);
  const double way = (p - middle).norm();
  return height > 0 ? std::max(data_.outside_m, height - way)
                    : std::min(-data_.inside_m, height + way);
}

FieldSample DistanceField::in_far_block(const std::array<int, 3>& block, const Vec3& p) const {
  FieldSample out;
  out.distance = bound_in(block, p);
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<int, 3> low = block, high = block;
    low[k] = std::max(0, block[k] - 1);
    high[k] = std::min(data_.blocks[k] - 1, block[k] + 1);
    const double rise = static_cast<double>(data_.middle[index_of(high)]) -
                        static_cast<double>(data_.middle[index_of(low)]);
    out.gradient[static_cast<Eigen::Index>(k)] = rise;
  }
  const double length = out.gradient.norm();
  out.gradient = length > 0 ? Vec3(out.gradient / length) : Vec3(Vec3::UnitZ());
  return out;
}

}  // namespace osteon
