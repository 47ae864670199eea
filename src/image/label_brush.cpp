#include <algorithm>
#include <cmath>

#include "osteon/image/label_tools.h"

namespace osteon {
namespace {

/// The way of a brush: a straight line with a radius, in the slice it is drawn in.
class BrushWay {
 public:
  BrushWay(const GridFrame& frame, const Vec3& from_voxel, const Vec3& to_voxel,
           const LabelBrush& brush)
      : frame_(frame), radius_m_(std::max(0.0, brush.radius_m)) {
    Vec3 from = from_voxel, to = to_voxel;
    if (brush.slice_axis >= 0) from[brush.slice_axis] = to[brush.slice_axis] = slice(to, brush);
    from_m_ = frame.spacing_m.cwiseProduct(from);
    way_m_ = frame.spacing_m.cwiseProduct(to) - from_m_;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const bool across = brush.slice_axis == static_cast<int>(a);
      const double reach = across ? 0 : radius_m_ / frame.spacing_m[axis];
      end_[a] = nearest(to[axis], frame.size[a]);
      const double lo = std::min(from[axis], to[axis]) - reach;
      const double hi = std::max(from[axis], to[axis]) + reach;
      box_.lo[a] = std::max(0, std::min(whole(std::ceil(lo), frame.size[a]), end_[a]));
      box_.hi[a] =
          std::min(frame.size[a], std::max(whole(std::floor(hi), frame.size[a]), end_[a]) + 1);
    }
  }

  const VoxelBox& box() const { return box_; }

  bool holds(int i, int j, int k) const {
    if (i == end_[0] && j == end_[1] && k == end_[2]) return true;
    const Vec3 p = frame_.spacing_m.cwiseProduct(Vec3(i, j, k)) - from_m_;
    const double length2 = way_m_.squaredNorm();
    const double share = length2 > 0 ? std::clamp(p.dot(way_m_) / length2, 0.0, 1.0) : 0.0;
    return (p - share * way_m_).squaredNorm() <= radius_m_ * radius_m_;
  }

 private:
  static double slice(const Vec3& to, const LabelBrush& brush) {
    return std::floor(to[brush.slice_axis] + 0.5);
  }
  /// As a whole number near the grid, whatever it was.
  static int whole(double x, int size) {
    return static_cast<int>(std::clamp(x, -2.0, static_cast<double>(size) + 2.0));
  }
  /// The voxel there; one beyond the grid stays beyond it.
  static int nearest(double x, int size) { return whole(std::floor(x + 0.5), size); }

  const GridFrame& frame_;
  double radius_m_;
  Vec3 from_m_, way_m_;
  std::array<int, 3> end_{};
  VoxelBox box_;
};

bool may_touch(const LabelEdit& edit, std::uint16_t label, const LabelBrush& brush, std::size_t n) {
  const std::uint16_t there = edit.labels().values[n];
  if (brush.erase ? there != label : there != 0 && !brush.over_others) return false;
  return !brush.within || brush.within->holds(edit.volume().values[n]);
}

}  // namespace

std::size_t dab_label(LabelEdit& edit, std::uint16_t label, const Vec3& from_voxel,
                      const Vec3& to_voxel, const LabelBrush& brush) {
  if (!edit.has(label) || !is_finite(from_voxel) || !is_finite(to_voxel)) return 0;
  const GridFrame& frame = edit.labels().frame;
  const BrushWay way(frame, from_voxel, to_voxel, brush);
  const std::uint16_t becomes = brush.erase ? std::uint16_t{0} : label;
  std::size_t changed = 0;
  for (int k = way.box().lo[2]; k < way.box().hi[2]; ++k)
    for (int j = way.box().lo[1]; j < way.box().hi[1]; ++j)
      for (int i = way.box().lo[0]; i < way.box().hi[0]; ++i) {
        const std::size_t n = frame.index(i, j, k);
        if (!may_touch(edit, label, brush, n) || !way.holds(i, j, k)) continue;
        changed += edit.set(n, 1, becomes);
      }
  return changed;
}

}  // namespace osteon
