#pragma once

#include <Eigen/Core>
#include <vector>

#include "osteon/base/types.h"

namespace osteon::tunnel {

using Vec2 = Eigen::Vector2d;

/// Twice the area of a, b, c; positive when they turn counter-clockwise.
inline double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// What a point of the drill's frame looks like along the line.
inline Vec2 flat(const Vec3& p_A) { return {p_A.x(), p_A.y()}; }

/// The drill's frame A: origin at `from`, z along the line.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

  Frame() = default;
  /// z runs along `along`, which has length.
  Frame(const Vec3& from, const Vec3& along);
  Vec3 to_A(const Vec3& p) const {
    const Vec3 r = p - origin;
    return {r.dot(x), r.dot(y), r.dot(z)};
  }
  Vec3 from_A(const Vec3& p_A) const { return origin + p_A.x() * x + p_A.y() * y + p_A.z() * z; }
};

/// What is moved a little until nothing touches the drill without crossing it.
struct Placing {
  double phase = 0;         ///< 0..1, of one side: how far the corners are turned
  double radius_shift = 0;  ///< m
  double end_shift = 0;     ///< m, of both ends, outwards
};

/// The drill in its frame: a prism as wide across as the cylinder, by area, whose corners, its
/// columns, lie on a circle of `radius`, between z = start and z = end. Side k lies between columns
/// k and k + 1.
struct Prism {
  double radius = 0;
  double start = 0, end = 0;
  double first_angle = 0, step = 0;
  std::vector<Vec2> columns;

  Prism(double radius_m, double start_m, double end_m, const Placing& placing);
  int sides() const { return static_cast<int>(columns.size()); }
  int wrapped(int k) const { return (k % sides() + sides()) % sides(); }
  const Vec2& column(int k) const { return columns[static_cast<std::size_t>(wrapped(k))]; }
  /// The side through which a ray from the axis to p goes.
  int side_of(const Vec2& p) const;
  /// Distance of p from the plane of side k, positive on the axis's side.
  double depth(int k, const Vec2& p) const;
};

/// Sides of a prism no point of which is farther than 0.25 um from its cylinder: a multiple of
/// four, from 96 to 720.
int sides_for(double radius);

}  // namespace osteon::tunnel
