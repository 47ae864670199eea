#include "surface/isosurface_grid.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kMostGridNodes = 2e8;
constexpr int kSmallestBlock = 4;

}  // namespace

/// Values of the nodes lo <= n < hi: one for all where the surface is surely elsewhere, else by
/// halves until the block is small.
void IsosurfaceGrid::fill(const LocalField& field, const int lo[3], const int hi[3]) {
  const Vec3 a = point(lo[0], lo[1], lo[2]), b = point(hi[0] - 1, hi[1] - 1, hi[2] - 1);
  // One cell more, because a crossed edge needs true values at both its ends.
  const LocalField::Near near = field.near(0.5 * (a + b), 0.5 * (b - a).norm() + cell_);
  if (near.sign != 0) return fill_with(near.sign, lo, hi);
  const LocalField& here = near.field ? *near.field : field;
  int widest = 0;
  for (int k = 1; k < 3; ++k)
    if (hi[k] - lo[k] > hi[widest] - lo[widest]) widest = k;
  if (hi[widest] - lo[widest] <= kSmallestBlock) return sample_nodes(here, lo, hi);
  const int middle = (lo[widest] + hi[widest]) / 2;
  int cut_lo[3] = {lo[0], lo[1], lo[2]}, cut_hi[3] = {hi[0], hi[1], hi[2]};
  cut_lo[widest] = cut_hi[widest] = middle;
  fill(here, lo, cut_hi);
  fill(here, cut_lo, hi);
}

void IsosurfaceGrid::fill_with(double value, const int lo[3], const int hi[3]) {
  for (int z = lo[2]; z < hi[2]; ++z)
    for (int y = lo[1]; y < hi[1]; ++y)
      std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(index(lo[0], y, z)), hi[0] - lo[0],
                  value);
}

void IsosurfaceGrid::sample_nodes(const LocalField& field, const int lo[3], const int hi[3]) {
  for (int z = lo[2]; z < hi[2]; ++z)
    for (int y = lo[1]; y < hi[1]; ++y)
      for (int x = lo[0]; x < hi[0]; ++x) values_[index(x, y, z)] = field.at(point(x, y, z));
}

bool IsosurfaceGrid::all_finite() const {
  return std::all_of(values_.begin(), values_.end(), [](double v) { return std::isfinite(v); });
}

bool IsosurfaceGrid::rim_is_outside() const {
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x) {
        const bool rim =
            x == 0 || y == 0 || z == 0 || x == n_[0] - 1 || y == n_[1] - 1 || z == n_[2] - 1;
        if (rim && value(x, y, z) < 0) return false;
        if (!rim && x == 1) x = std::max(x, n_[0] - 2);
      }
  return true;
}

Result<IsosurfaceGrid> IsosurfaceGrid::sample(const LocalField& field, const Aabb& box,
                                              double cell) {
  if (!std::isfinite(cell) || cell <= 0)
    return fail("the cell must be a positive length", "isosurface");
  if (box.empty() || !is_finite(box.lo) || !is_finite(box.hi))
    return fail("the box is empty or not finite", "isosurface");
  const Vec3 nodes = (box.extent() / cell).array().ceil() + 3;
  if (nodes.x() * nodes.y() * nodes.z() > kMostGridNodes)
    return fail("the grid would have more than 200 million points", "isosurface",
                "Choose a larger cell");
  IsosurfaceGrid grid;
  for (int k = 0; k < 3; ++k) grid.n_[k] = static_cast<int>(nodes[k]);
  grid.cell_ = cell;
  grid.origin_ = box.lo - Vec3::Constant(cell);
  grid.values_.assign(static_cast<std::size_t>(nodes.x() * nodes.y() * nodes.z()), 0);
  const int lo[3] = {0, 0, 0};
  grid.fill(field, lo, grid.n_);
  if (!grid.all_finite()) return fail("the field is not finite everywhere", "isosurface");
  if (!grid.rim_is_outside())
    return fail("the inside reaches the rim of the box", "isosurface", "Choose a larger box");
  return grid;
}

}  // namespace osteon
