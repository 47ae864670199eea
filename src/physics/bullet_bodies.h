#pragma once

#include <cstddef>
#include <memory>

#include "mass_properties.h"
#include "osteon/base/types.h"

namespace osteon {

/// A Bullet world of rigid bodies that do not collide, without gravity. Bodies are numbered in the
/// order in which they were added; a body's frame I is that of its mass properties.
class BulletBodies {
 public:
  BulletBodies();
  ~BulletBodies();
  BulletBodies(BulletBodies&&) noexcept;

  /// `half_extent`: of the box that stands for the body, along the axes of I.
  void add(const MassProperties& mass, const Vec3& half_extent);
  void set(std::size_t body, const Pose& X_WI, const Vec3& v_W, const Vec3& w_W);
  /// Moves every body by its velocities.
  void advance(double dt_s);
  Pose pose(std::size_t body) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
