#include "nearest_simplex.h"

#include <cmath>
#include <limits>

namespace osteon {
namespace {

// Weights of the origin's projection on the affine hull of some points, the first of them new;
// false when the points are not independent or a weight is not positive.
bool project(const Vec3& a, const Vec3& b, double& wb) {
  const Vec3 e = b - a;
  wb = -a.dot(e) / e.squaredNorm();
  return wb > 0 && wb < 1;
}

bool project(const Vec3& a, const Vec3& b, const Vec3& c, double& wb, double& wc) {
  const Vec3 e = b - a, f = c - a;
  const Vec3 n = e.cross(f);
  const double inverse = 1 / n.squaredNorm();
  wb = n.dot(f.cross(a)) * inverse;
  wc = n.dot(a.cross(e)) * inverse;
  return wb > 0 && wc > 0 && wb + wc < 1;
}

bool surrounds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 e = b - a, f = c - a, g = d - a;
  const double inverse = 1 / e.dot(f.cross(g));
  const double wb = -a.dot(f.cross(g)) * inverse;
  const double wc = -e.dot(a.cross(g)) * inverse;
  const double wd = -e.dot(f.cross(a)) * inverse;
  return wb > 0 && wc > 0 && wd > 0 && wb + wc + wd < 1;
}

// The best so far, among the subsets that hold the new point.
class Best {
 public:
  void offer(std::array<std::size_t, 3> members, std::array<double, 3> weights, std::size_t count,
             const Vec3& nearest) {
    const double square = nearest.squaredNorm();
    if (!(square < square_)) return;
    square_ = square;
    members_ = members;
    weights_ = weights;
    count_ = count;
  }
  void keep(NearestSimplex& simplex) const {
    const auto old = simplex.points;
    for (std::size_t k = 0; k < count_; ++k) {
      simplex.points[k] = old[members_[k]];
      simplex.weights[k] = weights_[k];
    }
    simplex.count = count_;
  }

 private:
  double square_ = std::numeric_limits<double>::infinity();
  std::array<std::size_t, 3> members_{};
  std::array<double, 3> weights_{};
  std::size_t count_ = 0;
};

Vec3 blend(const NearestSimplex& s, Vec3 DifferencePoint::*part) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.count; ++k) sum += s.weights[k] * (s.points[k].*part);
  return sum;
}

}  // namespace

Vec3 NearestSimplex::nearest() const { return blend(*this, &DifferencePoint::w); }
Vec3 NearestSimplex::on_body() const { return blend(*this, &DifferencePoint::p_a); }
Vec3 NearestSimplex::on_axis() const { return blend(*this, &DifferencePoint::p_ax); }

bool add_point(NearestSimplex& s, const DifferencePoint& point) {
  const std::size_t n = s.count;
  s.points[n] = point;
  const auto at = [&](std::size_t k) -> const Vec3& { return s.points[k].w; };
  const Vec3& a = at(n);
  if (n == 3 && surrounds(a, at(0), at(1), at(2))) return true;
  Best best;
  best.offer({n, 0, 0}, {1, 0, 0}, 1, a);
  for (std::size_t i = 0; i < n; ++i) {
    double wb = 0, wc = 0;
    if (project(a, at(i), wb)) best.offer({n, i, 0}, {1 - wb, wb, 0}, 2, a + wb * (at(i) - a));
    for (std::size_t j = i + 1; j < n; ++j)
      if (project(a, at(i), at(j), wb, wc))
        best.offer({n, i, j}, {1 - wb - wc, wb, wc}, 3, a + wb * (at(i) - a) + wc * (at(j) - a));
  }
  best.keep(s);
  return false;
}

}  // namespace osteon
