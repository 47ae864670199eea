#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"

namespace osteon::hull {

/// Plane n.q = d in the scaled frame S with a unit normal. A point whose height is beyond +-bound
/// is on that side for certain; one within is undecided.
struct FilterPlane {
  double nx = 0, ny = 0, nz = 0, d = 0;
  double bound = 0;

  double height(const Vec3& q_S) const {
    return (nx * q_S.x() + ny * q_S.y()) + (nz * q_S.z() - d);
  }
};

/// The input beside a copy in the scaled frame S (centred, sides at most 2) on which the filter
/// runs with bounds that need no look at the magnitudes. Whatever the filter leaves undecided is
/// settled exactly on the input itself.
class Cloud {
 public:
  /// All points finite; they outlive the cloud.
  explicit Cloud(std::span<const Vec3> points);
  Cloud(const Cloud&) = delete;
  Cloud& operator=(const Cloud&) = delete;
  /// Copies of some points of another cloud, in this order and in the same frame S.
  Cloud(const Cloud& from, std::span<const std::uint32_t> order);

  std::uint32_t size() const { return static_cast<std::uint32_t>(raw_.size()); }
  const Vec3& raw(std::uint32_t i) const { return raw_[i]; }
  const Vec3& scaled(std::uint32_t i) const { return scaled_[i]; }

  /// A point of the input's frame in S, and lengths there by this factor.
  Vec3 to_scaled(const Vec3& p) const { return scale_ * p - centre_; }
  double scale() const { return scale_; }

  FilterPlane plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// Exact side of point p of the plane a, b, c, for a height that the filter leaves undecided.
  int exact_side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const;
  std::size_t exact_tests() const { return exact_tests_; }
  std::size_t* exact_counter() const { return &exact_tests_; }

 private:
  std::vector<Vec3> own_;
  std::span<const Vec3> raw_;
  std::vector<Vec3> scaled_;
  double scale_ = 1;
  Vec3 centre_ = Vec3::Zero();
  mutable std::size_t exact_tests_ = 0;
};

/// Plane through three points of frame S.
FilterPlane filter_plane(const Vec3& a_S, const Vec3& b_S, const Vec3& c_S);

}  // namespace osteon::hull
