#include "height_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/mesh/measure.h"

namespace osteon::hull {
namespace {

constexpr int kMargin = 2;               // cells around the mesh
constexpr std::uint32_t kBlockSide = 8;  // nodes along a block
constexpr std::uint32_t kBlockNodes = kBlockSide * kBlockSide * kBlockSide;
constexpr std::uint32_t kNoBlock = 0xffffffffu;

std::uint32_t within_block(const std::array<std::uint32_t, 3>& node) {
  return (node[2] % kBlockSide * kBlockSide + node[1] % kBlockSide) * kBlockSide +
         node[0] % kBlockSide;
}

}  // namespace

HeightGrid::HeightGrid(const TriMesh& mesh, double cell_m, std::uint64_t work)
    : exact_(mesh), work_left_(work), cell_(cell_m) {
  const Aabb box = bounds(mesh).grown(kMargin * cell_m);
  lo_ = box.lo;
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double cells = box.extent()[static_cast<Eigen::Index>(k)] / cell_;
    size_[k] = 2 + static_cast<std::uint32_t>(std::floor(cells));
    blocks_[k] = (size_[k] + kBlockSide - 1) / kBlockSide;
    count *= blocks_[k];
  }
  first_.assign(count, kNoBlock);
}

std::size_t HeightGrid::block_of(const Node& node) const {
  return (std::size_t{node[2] / kBlockSide} * blocks_[1] + node[1] / kBlockSide) * blocks_[0] +
         node[0] / kBlockSide;
}

double HeightGrid::value(const Node& node) {
  const std::size_t block = block_of(node);
  if (first_[block] == kNoBlock) {
    first_[block] = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + kBlockNodes, std::numeric_limits<double>::quiet_NaN());
  }
  double& known = values_[first_[block] + within_block(node)];
  if (std::isnan(known)) {
    const ClosestPoint found = exact_.closest(lo_ + cell_ * Vec3(node[0], node[1], node[2]), last_);
    last_ = found.triangle;
    known = found.signed_distance;
  }
  return known;
}

bool HeightGrid::known_corners(const Node& cell, Corners& corners) const {
  for (const std::uint32_t n : cell)
    if (n % kBlockSide == kBlockSide - 1) return false;
  const std::uint32_t first = first_[block_of(cell)];
  if (first == kNoBlock) return false;
  const double* const at = &values_[first + within_block(cell)];
  constexpr std::uint32_t kY = kBlockSide, kZ = kBlockSide * kBlockSide;
  corners = {at[0], at[1], at[kY], at[kY + 1], at[kZ], at[kZ + 1], at[kZ + kY], at[kZ + kY + 1]};
  return true;
}

HeightGrid::Corners HeightGrid::make_corners(const Node& cell) {
  Corners corners{};
  for (std::uint32_t k = 0; k < corners.size(); ++k)
    corners[k] = value({cell[0] + (k & 1), cell[1] + ((k >> 1) & 1), cell[2] + (k >> 2)});
  return corners;
}

double HeightGrid::at(const Vec3& p) {
  if (work_left_ > 0) --work_left_;
  Node cell{};
  Vec3 f;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double u = std::clamp((p[axis] - lo_[axis]) / cell_, 0.0, size_[k] - 1.000001);
    cell[k] = static_cast<std::uint32_t>(u);
    f[axis] = u - cell[k];
  }
  const auto between = [&f](const Corners& h) {
    const double a = h[0] + f.x() * (h[1] - h[0]), b = h[2] + f.x() * (h[3] - h[2]);
    const double c = h[4] + f.x() * (h[5] - h[4]), d = h[6] + f.x() * (h[7] - h[6]);
    const double low = a + f.y() * (b - a), high = c + f.y() * (d - c);
    return low + f.z() * (high - low);
  };
  Corners corners;
  if (known_corners(cell, corners)) {
    const double height = between(corners);
    if (!std::isnan(height)) return height;
  }
  return between(make_corners(cell));
}

Vec3 HeightGrid::upwards(const Vec3& p) {
  Vec3 slope;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec3 step = cell_ * Vec3::Unit(k);
    const double high = at(p + step);
    const double low = at(p - step);
    slope[k] = high - low;
  }
  const double length = slope.norm();
  return length > 0 ? Vec3(slope / length) : Vec3(Vec3::Zero());
}

}  // namespace osteon::hull
