#include "slerp.h"

#include <cmath>

namespace osteon {
namespace {

using Coeffs = Eigen::Matrix<double, 4, 1, Eigen::DontAlign>;

Coeffs unit(const Coeffs& c) { return c / std::sqrt(c.squaredNorm()); }

// 1 - cos(4 mrad) of the angle between the quaternions.
constexpr double kNear = 8e-6;

}  // namespace

Quat slerp(const Quat& a, const Quat& b, double t) {
  Coeffs lo = a.coeffs();
  Coeffs hi = b.coeffs();
  if (lo.dot(hi) < 0) hi = -hi;
  while (1 - lo.dot(hi) > kNear) {
    const Coeffs middle = unit(lo + hi);
    t *= 2;
    if (t < 1) {
      hi = middle;
    } else {
      lo = middle;
      t -= 1;
    }
  }
  Quat q;
  q.coeffs() = unit((1 - t) * lo + t * hi);
  return q;
}

}  // namespace osteon
