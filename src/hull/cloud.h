#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "osteon/base/types.h"

namespace osteon::hull {

inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

/// Plane n.q = d in the scaled frame S with a unit normal. A point whose height is beyond +-bound
/// is on that side for certain; one within is undecided.
struct FilterPlane {
  double nx = 0, ny = 0, nz = 0, d = 0;
  double bound = 0;

  double height(const Vec3& q_S) const {
    return (nx * q_S.x() + ny * q_S.y()) + (nz * q_S.z() - d);
  }
};

/// Power of two that brings `half_extent` into [0.5, 1), as far as doubles reach.
double scale_to_one(double half_extent);

/// The input and its scaled frame S (centred, sides at most 2), in which filters run with bounds
/// that need no look at the magnitudes. Whatever a filter leaves undecided is settled exactly on
/// the input itself.
class Cloud {
 public:
  /// All points finite, within the box and filling it; they outlive the cloud.
  Cloud(std::span<const Vec3> points, const Aabb& box);

  std::uint32_t size() const { return static_cast<std::uint32_t>(raw_.size()); }
  const Vec3& raw(std::uint32_t i) const { return raw_[i]; }
  std::span<const Vec3> points() const { return raw_; }
  const Aabb& box() const { return box_; }
  Vec3 scaled(std::uint32_t i) const { return scale_ * raw_[i] - centre_; }

  FilterPlane plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// Exact side of point p of the plane a, b, c, for a height that the filter leaves undecided.
  int exact_side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const;
  std::size_t exact_tests() const { return exact_tests_; }
  std::size_t* exact_counter() const { return &exact_tests_; }

 private:
  std::span<const Vec3> raw_;
  Aabb box_;
  double scale_ = 1;
  Vec3 centre_ = Vec3::Zero();
  mutable std::size_t exact_tests_ = 0;
};

/// Box of the points; empty when a coordinate is not finite.
Aabb finite_box(std::span<const Vec3> points);

}  // namespace osteon::hull
