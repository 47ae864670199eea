#pragma once

#include <vector>

#include "osteon/mesh/isosurface.h"

namespace osteon {

/// Samples of a field on a cubic grid around a box. Nodes that cannot touch the surface carry 1 or
/// -1: right in sign, not in size.
class IsosurfaceGrid {
 public:
  static Result<IsosurfaceGrid> sample(const LocalField& field, const Aabb& box, double cell);

  int nx() const { return n_[0]; }
  int ny() const { return n_[1]; }
  int nz() const { return n_[2]; }
  std::size_t size() const { return values_.size(); }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(n_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(n_[0]) +
           static_cast<std::size_t>(x);
  }
  double value(int x, int y, int z) const { return values_[index(x, y, z)]; }
  Vec3 point(int x, int y, int z) const { return origin_ + cell_ * Vec3(x, y, z); }

 private:
  void fill(const LocalField& field, const int lo[3], const int hi[3]);
  void fill_with(double value, const int lo[3], const int hi[3]);
  void sample_nodes(const LocalField& field, const int lo[3], const int hi[3]);
  bool all_finite() const;
  bool rim_is_outside() const;

  int n_[3] = {0, 0, 0};
  Vec3 origin_ = Vec3::Zero();
  double cell_ = 0;
  std::vector<double> values_;
};

}  // namespace osteon
