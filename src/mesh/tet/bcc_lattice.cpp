#include "tet/bcc_lattice.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kMostCubes = 6e7;
constexpr int kSmallestLatticeBlock = 4;

}  // namespace

Vec3 BccLattice::place(std::uint32_t point) const {
  const bool centered = point >= half();
  std::uint32_t rest = centered ? point - half() : point;
  const auto nx = static_cast<std::uint32_t>(n_[0]);
  const auto ny = static_cast<std::uint32_t>(n_[1]);
  const std::uint32_t x = rest % nx;
  rest /= nx;
  const double shift = centered ? 0.5 : 0.0;
  return origin_ + cell_ * Vec3(x + shift, rest % ny + shift, rest / ny + shift);
}

std::array<std::uint32_t, 14> BccLattice::neighbours(std::uint32_t point) const {
  const auto nx = static_cast<std::uint32_t>(n_[0]);
  const std::uint32_t nxy = nx * static_cast<std::uint32_t>(n_[1]);
  std::array<std::uint32_t, 14> out{point - 1,  point + 1,   point - nx,
                                    point + nx, point - nxy, point + nxy};
  // A centre's cube has its corners at and above it; a corner's cubes lie at and below it.
  const bool centered = point >= half();
  const std::uint32_t base = centered ? point - half() : point + half() - 1 - nx - nxy;
  for (std::uint32_t c = 0; c < 8; ++c)
    out[kLongEdges + c] = base + (c & 1u) + (c >> 1 & 1u) * nx + (c >> 2) * nxy;
  return out;
}

void BccLattice::set(std::uint32_t point, double value) {
  if (!std::isfinite(value)) all_finite_ = false;
  any_inside_ |= value < 0;
  sides_[point] = value < 0   ? LatticeSide::kInside
                  : value > 0 ? LatticeSide::kOutside
                              : LatticeSide::kOn;
}

/// Sides of the points of the cubes lo <= n < hi: one for all where the surface is surely
/// elsewhere, else by halves until the block is small.
void BccLattice::fill(const ScalarField& field, const StuffingOptions& options,
                      const std::array<int, 3>& lo, const std::array<int, 3>& hi) {
  std::size_t widest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (hi[k] - lo[k] > hi[widest] - lo[widest]) widest = k;
  if (hi[widest] - lo[widest] <= kSmallestLatticeBlock) return sample_points(field, lo, hi);
  const Vec3 a = place(corner(lo[0], lo[1], lo[2]));
  const Vec3 b = place(center(hi[0] - 1, hi[1] - 1, hi[2] - 1));
  const double at_center = field(0.5 * (a + b));
  if (std::abs(at_center) > options.stretch * 0.5 * (b - a).norm() + options.slack_m) {
    for (int z = lo[2]; z < hi[2]; ++z)
      for (int y = lo[1]; y < hi[1]; ++y)
        for (int x = lo[0]; x < hi[0]; ++x) {
          set(corner(x, y, z), at_center);
          set(center(x, y, z), at_center);
        }
    return;
  }
  const int middle = (lo[widest] + hi[widest]) / 2;
  std::array<int, 3> cut_lo = lo;
  std::array<int, 3> cut_hi = hi;
  cut_lo[widest] = cut_hi[widest] = middle;
  fill(field, options, lo, cut_hi);
  fill(field, options, cut_lo, hi);
}

void BccLattice::sample_points(const ScalarField& field, const std::array<int, 3>& lo,
                               const std::array<int, 3>& hi) {
  for (int z = lo[2]; z < hi[2]; ++z)
    for (int y = lo[1]; y < hi[1]; ++y)
      for (int x = lo[0]; x < hi[0]; ++x)
        for (const std::uint32_t point : {corner(x, y, z), center(x, y, z)})
          set(point, field(place(point)));
}

bool BccLattice::rim_is_outside() const {
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x) {
        const bool rim =
            x == 0 || y == 0 || z == 0 || x >= n_[0] - 2 || y >= n_[1] - 2 || z >= n_[2] - 2;
        if (!rim) continue;
        if (side(corner(x, y, z)) == LatticeSide::kInside) return false;
        if (side(center(x, y, z)) == LatticeSide::kInside) return false;
      }
  return true;
}

Result<BccLattice> BccLattice::sample(const ScalarField& field, const Aabb& box,
                                      const StuffingOptions& options) {
  const std::string where = "tetrahedra";
  const double cell = options.cell_m;
  if (!std::isfinite(cell) || cell <= 0)
    return fail("the cell must be a positive length", where, "Choose one in millimetres");
  if (box.empty() || !is_finite(box.lo) || !is_finite(box.hi))
    return fail("the box is empty or not finite", where, "Check the surface's coordinates");
  if (!(options.stretch >= 1) || !(options.slack_m >= 0))
    return fail("stretch must be 1 or more and slack 0 or more", where);
  const Vec3 cubes = (box.extent() / cell).array().ceil() + 5;
  if (cubes.x() * cubes.y() * cubes.z() > kMostCubes)
    return fail("the lattice would have more than 60 million cubes (120 MB)", where,
                "Choose a larger cell");
  BccLattice lattice;
  for (std::size_t k = 0; k < 3; ++k)
    lattice.n_[k] = static_cast<int>(cubes[static_cast<Vec3::Index>(k)]);
  lattice.cell_ = cell;
  lattice.origin_ = box.lo - Vec3::Constant(2 * cell);
  const auto count = static_cast<std::size_t>(cubes.x() * cubes.y() * cubes.z());
  lattice.sides_.assign(2 * count, LatticeSide::kOutside);
  lattice.fill(field, options, {0, 0, 0}, lattice.n_);
  if (!lattice.all_finite_)
    return fail("the field is not finite everywhere", where, "Check the surface's coordinates");
  if (!lattice.any_inside_)
    return fail("no point of the lattice lies inside: the part is thinner than a cell", where,
                "Choose a smaller cell, or check that the surface faces outwards");
  if (!lattice.rim_is_outside())
    return fail("the inside reaches the rim of the box", where, "Choose a larger box");
  return lattice;
}

}  // namespace osteon
