#pragma once

#include <functional>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// A slow field, evaluated once at each node of a grid that is asked for and interpolated
/// trilinearly between them; outside the grid's box it is evaluated itself. For one thread.
class SampledField {
 public:
  using Field = std::function<double(const Vec3&)>;
  SampledField(Field field, const Aabb& box, double cell_m);

  double operator()(const Vec3& p);

 private:
  double node(int x, int y, int z);

  Field field_;
  Vec3 origin_;
  double cell_;
  int n_[3];
  std::vector<double> values_;  ///< NaN: not asked for yet
};

}  // namespace osteon
