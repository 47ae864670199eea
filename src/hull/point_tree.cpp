#include "point_tree.h"

#include <algorithm>
#include <cmath>

namespace osteon::hull {

namespace {

/// Covers the rounding of centres, axes and bounds, all of magnitude 4 at most in frame S.
constexpr double kPad = 1e-14;

struct Box {
  Vec3 lo, hi;
};

Box box_of(std::span<const std::uint32_t> points, const Cloud& cloud) {
  Box box{cloud.scaled(points[0]), cloud.scaled(points[0])};
  for (const std::uint32_t p : points) {
    box.lo = box.lo.cwiseMin(cloud.scaled(p));
    box.hi = box.hi.cwiseMax(cloud.scaled(p));
  }
  return box;
}

Vec3 mean_normal(std::span<const std::uint32_t> points, std::span<const Vec3> normals_S) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t p : points) sum += normals_S[p];
  const double length = std::sqrt(sum.squaredNorm());
  if (!(length > 1e-6)) return Vec3::UnitZ();
  return sum / length;
}

PointTree::Node cylinder(std::span<const std::uint32_t> points, const Vec3& axis, const Box& box,
                         const Cloud& cloud) {
  Vec3 c = 0.5 * (box.lo + box.hi);
  double low = 4, high = -4, square = 0;
  for (const std::uint32_t p : points) {
    const Vec3 r = cloud.scaled(p) - c;
    const double along = axis.dot(r);
    low = std::min(low, along);
    high = std::max(high, along);
    square = std::max(square, (r - along * axis).squaredNorm());
  }
  c += 0.5 * (low + high) * axis;
  PointTree::Node node{};
  node.cx = c.x(), node.cy = c.y(), node.cz = c.z();
  node.mx = axis.x(), node.my = axis.y(), node.mz = axis.z();
  node.half_height = 0.5 * (high - low) + kPad;
  node.radius = std::sqrt(square) + kPad;
  return node;
}

/// A rough outward direction at each survivor. Steers the search, decides nothing.
std::vector<Vec3> outward_normals(const Shell& shell) {
  std::vector<Vec3> normals_S(shell.points.size(), Vec3::Zero());
  for (const Shell::Facet& f : shell.facets) {
    const Vec3 n_S(f.plane.nx, f.plane.ny, f.plane.nz);
    for (const std::uint32_t v : f.v) normals_S[v] += n_S;
    for (std::uint32_t p = f.outside_begin; p < f.outside_end; ++p) normals_S[p] = n_S;
  }
  return normals_S;
}

}  // namespace

double PointTree::Node::highest(const FilterPlane& plane) const {
  const double cosine = (plane.nx * mx + plane.ny * my) + plane.nz * mz;
  // The term 1e-15 keeps the root above the true sine where the difference cancels.
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine) + 1e-15);
  const double middle = (plane.nx * cx + plane.ny * cy) + (plane.nz * cz - plane.d);
  return middle + std::abs(cosine) * half_height + sine * radius + kPad;
}

PointTree::PointTree(const Cloud& survivors, const Shell& shell) {
  const std::size_t n = survivors.size();
  order_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) order_[i] = i;
  leaf_of_.resize(n);
  nodes_.reserve(n / 2 + 1);
  build(0, static_cast<std::uint32_t>(n), survivors, outward_normals(shell));
  for (std::vector<double>* axis : {&x_, &y_, &z_}) axis->assign(n + kLeafSize, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& q_S = survivors.scaled(order_[i]);
    x_[i] = q_S.x();
    y_[i] = q_S.y();
    z_[i] = q_S.z();
  }
}

std::uint32_t PointTree::build(std::uint32_t begin, std::uint32_t end, const Cloud& survivors,
                               std::span<const Vec3> normals_S) {
  const std::span<std::uint32_t> mine(order_.data() + begin, end - begin);
  const Box box = box_of(mine, survivors);
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(cylinder(mine, mean_normal(mine, normals_S), box, survivors));
  nodes_[index].begin = begin;
  nodes_[index].end = end;
  if (end - begin <= kLeafSize) {
    for (const std::uint32_t p : mine) leaf_of_[p] = index;
    return index;
  }
  Eigen::Index axis = 0;
  (box.hi - box.lo).maxCoeff(&axis);
  const auto middle = mine.begin() + static_cast<std::ptrdiff_t>(mine.size() / 2);
  std::nth_element(mine.begin(), middle, mine.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double x = survivors.scaled(a)[axis], y = survivors.scaled(b)[axis];
    return x != y ? x < y : a < b;
  });
  const auto split = begin + static_cast<std::uint32_t>(mine.size() / 2);
  build(begin, split, survivors, normals_S);
  const std::uint32_t right = build(split, end, survivors, normals_S);
  nodes_[index].right = right;
  return index;
}

}  // namespace osteon::hull
