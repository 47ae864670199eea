#include "soft/rim_outline.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace osteon {
namespace {

using RimPoint = std::array<double, 2>;

double corner_turn(const RimPoint& a, const RimPoint& b, const RimPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Andrew's chain (1979).
std::vector<RimPoint> convex_outline(std::vector<RimPoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<RimPoint> out;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = out.size();
    for (const RimPoint& p : points) {
      while (out.size() >= first + 2 && corner_turn(out[out.size() - 2], out.back(), p) <= 0)
        out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return out;
}

}  // namespace

RimOutline::RimOutline(std::span<const Vec3> points, const Vec3& below) {
  for (const Vec3& p : points) middle_ += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - middle_) * (p - middle_).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  up_ = axes.eigenvectors().col(0);
  if (up_.dot(middle_ - below) < 0) up_ = -up_;
  right_ = up_.unitOrthogonal();
  ahead_ = up_.cross(right_);
  std::vector<RimPoint> seen;
  for (const Vec3& p : points) seen.push_back(flat(p));
  corners_ = convex_outline(std::move(seen));
}

std::array<double, 2> RimOutline::flat(const Vec3& p) const {
  return {right_.dot(p - middle_), ahead_.dot(p - middle_)};
}

double RimOutline::inside(const Vec3& p) const {
  const RimPoint at = flat(p);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const RimPoint &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 0) least = std::min(least, corner_turn(a, b, at) / length);
  }
  return least;
}

}  // namespace osteon
