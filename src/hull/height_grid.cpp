#include "height_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/mesh/measure.h"

namespace osteon::hull {
namespace {

constexpr int kMargin = 2;  // cells around the mesh
constexpr int kSide = 8;    // nodes along a block
constexpr std::uint32_t kBlockNodes = kSide * kSide * kSide;
constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace

HeightGrid::HeightGrid(const TriMesh& mesh, double cell_m) : exact_(mesh), cell_(cell_m) {
  const Aabb box = bounds(mesh).grown(kMargin * cell_m);
  lo_ = box.lo;
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double cells = box.extent()[static_cast<Eigen::Index>(k)] / cell_;
    size_[k] = 2 + static_cast<int>(std::floor(cells));
    blocks_[k] = (size_[k] + kSide - 1) / kSide;
    count *= static_cast<std::size_t>(blocks_[k]);
  }
  first_.assign(count, kNone);
}

double HeightGrid::value(const Node& node) {
  const auto block = static_cast<std::size_t>(
      (node[2] / kSide * blocks_[1] + node[1] / kSide) * blocks_[0] + node[0] / kSide);
  if (first_[block] == kNone) {
    first_[block] = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + kBlockNodes, std::numeric_limits<double>::quiet_NaN());
  }
  const int within = (node[2] % kSide * kSide + node[1] % kSide) * kSide + node[0] % kSide;
  double& known = values_[first_[block] + static_cast<std::uint32_t>(within)];
  if (std::isnan(known))
    known = exact_.closest(lo_ + cell_ * Vec3(node[0], node[1], node[2])).signed_distance;
  return known;
}

double HeightGrid::at(const Vec3& p) {
  Node cell{};
  Vec3 f;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double u = std::clamp((p[axis] - lo_[axis]) / cell_, 0.0, size_[k] - 1.000001);
    cell[k] = static_cast<int>(u);
    f[axis] = u - cell[k];
  }
  const auto along_x = [&](int y, int z) {
    const double low = value({cell[0], cell[1] + y, cell[2] + z});
    const double high = value({cell[0] + 1, cell[1] + y, cell[2] + z});
    return low + f.x() * (high - low);
  };
  const double a = along_x(0, 0), b = along_x(1, 0), c = along_x(0, 1), d = along_x(1, 1);
  const double low = a + f.y() * (b - a), high = c + f.y() * (d - c);
  return low + f.z() * (high - low);
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
