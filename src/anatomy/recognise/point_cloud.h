#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// Finds the nearest of a fixed set of points, in single precision; of several as near the first.
class PointCloud {
 public:
  explicit PointCloud(const std::vector<Vec3>& points);
  struct Hit {
    std::size_t index = 0;
    double distance_m = 1e9;
  };
  Hit nearest(const Vec3& p) const;
  std::size_t size() const { return size_; }

 private:
  struct Tree;
  Vec3 middle_ = Vec3::Zero();
  std::size_t size_ = 0;
  std::shared_ptr<const Tree> tree_;  ///< null: of no points
};

/// Every n-th of the points, so that about `most` are left.
std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::size_t most);

}  // namespace osteon
