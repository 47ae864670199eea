#include "bone/sampled_field.h"

#include <cmath>
#include <limits>
#include <utility>

namespace osteon {

SampledField::SampledField(Field field, const Aabb& box, double cell_m)
    : field_(std::move(field)), origin_(box.lo), cell_(cell_m) {
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    n_[k] = static_cast<int>(std::ceil(box.extent()[k] / cell_m)) + 2;
    count *= static_cast<std::size_t>(n_[k]);
  }
  values_.assign(count, std::numeric_limits<double>::quiet_NaN());
}

double SampledField::node(int x, int y, int z) {
  const auto at = (static_cast<std::size_t>(z) * static_cast<std::size_t>(n_[1]) +
                   static_cast<std::size_t>(y)) *
                      static_cast<std::size_t>(n_[0]) +
                  static_cast<std::size_t>(x);
  double& value = values_[at];
  if (std::isnan(value)) value = field_(origin_ + cell_ * Vec3(x, y, z));
  return value;
}

double SampledField::operator()(const Vec3& p) {
  const Vec3 at = (p - origin_) / cell_;
  int i[3];
  double f[3];
  for (int k = 0; k < 3; ++k) {
    const double whole = std::floor(at[k]);
    if (!(whole >= 0) || whole > n_[k] - 2) return field_(p);
    i[k] = static_cast<int>(whole);
    f[k] = at[k] - whole;
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = (corner >> 1) & 1, z = corner >> 2;
    const double weight = (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]);
    if (weight > 0) sum += weight * node(i[0] + x, i[1] + y, i[2] + z);
  }
  return sum;
}

}  // namespace osteon
