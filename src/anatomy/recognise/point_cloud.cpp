#include "recognise/point_cloud.h"

#include <cmath>

namespace osteon {

PointCloud::PointCloud(const std::vector<Vec3>& points) {
  if (!points.empty()) middle_ = points.front();
  for (const Vec3& p : points) {
    x_.push_back(static_cast<float>(p.x() - middle_.x()));
    y_.push_back(static_cast<float>(p.y() - middle_.y()));
    z_.push_back(static_cast<float>(p.z() - middle_.z()));
  }
}

PointCloud::Hit PointCloud::nearest(const Vec3& p) const {
  const Vec3 q = p - middle_;
  const auto x = static_cast<float>(q.x()), y = static_cast<float>(q.y()),
             z = static_cast<float>(q.z());
  float best = 1e9f;
  std::size_t index = 0;
  for (std::size_t n = 0; n < x_.size(); ++n) {
    const float dx = x_[n] - x, dy = y_[n] - y, dz = z_[n] - z;
    const float d2 = dx * dx + dy * dy + dz * dz;
    if (d2 < best) {
      best = d2;
      index = n;
    }
  }
  return {index, std::sqrt(static_cast<double>(best))};
}

std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < most; ++n) out.push_back(points[n * points.size() / most]);
  return out;
}

}  // namespace osteon
