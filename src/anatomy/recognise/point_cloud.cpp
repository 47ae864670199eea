#include "recognise/point_cloud.h"

#include <array>
#include <cmath>
#include <nanoflann.hpp>

namespace osteon {

// Not in the unnamed namespace: a field's type may not be from there where files are joined.
using CloudPoint = std::array<float, 3>;

struct CloudPoints {
  std::vector<CloudPoint> at;
  std::size_t kdtree_get_point_count() const { return at.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return at[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using CloudTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, CloudPoints>,
                                        CloudPoints, 3, std::size_t>;

namespace {

/// The nearest point, of several as near the first: what trying all in order finds, whatever the
/// order of the search. Branches are left only when they are farther by more than rounding.
class FirstNearest {
 public:
  float worstDist() const { return best_ * 1.001f; }
  bool addPoint(float distance2, std::size_t index) {
    if (distance2 < best_ || (distance2 == best_ && index < index_)) {
      best_ = distance2;
      index_ = index;
    }
    return true;
  }
  bool full() const { return true; }
  std::size_t size() const { return 1; }
  float distance2() const { return best_; }
  std::size_t index() const { return index_; }

 private:
  float best_ = 1e9f;
  std::size_t index_ = 0;
};

}  // namespace

struct PointCloud::Tree {
  explicit Tree(CloudPoints all) : points(std::move(all)), index(3, points) { index.buildIndex(); }
  CloudPoints points;
  CloudTree index;
};

PointCloud::PointCloud(const std::vector<Vec3>& points) : size_(points.size()) {
  if (points.empty()) return;
  middle_ = points.front();
  CloudPoints near;
  for (const Vec3& p : points) {
    const Vec3 q = p - middle_;
    near.at.push_back(
        {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())});
  }
  tree_ = std::make_shared<const Tree>(std::move(near));
}

PointCloud::Hit PointCloud::nearest(const Vec3& p) const {
  FirstNearest first;
  const Vec3 q = p - middle_;
  const CloudPoint at{static_cast<float>(q.x()), static_cast<float>(q.y()),
                      static_cast<float>(q.z())};
  if (tree_) tree_->index.findNeighbors(first, at.data(), nanoflann::SearchParams());
  return {first.index(), std::sqrt(static_cast<double>(first.distance2()))};
}

std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < most; ++n) out.push_back(points[n * points.size() / most]);
  return out;
}

}  // namespace osteon
