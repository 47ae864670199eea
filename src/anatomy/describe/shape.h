#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

// Implicit shapes: functions that are negative inside, positive outside, and near the surface about
// the distance to it. All arithmetic is + - * / sqrt, so every compiler gets the same bits.

/// Ellipsoid; the value is the first-order distance k0 (k0 - 1) / k1 with k0 = |p / r| and
/// k1 = |p / r^2| (I. Quilez, "Ellipsoid distance", 2008): exact on the surface to second order.
struct Ellipsoid {
  Vec3 center = Vec3::Zero();
  Vec3 radii = Vec3::Ones();
  Mat3 R_local = Mat3::Identity();  ///< turns bone directions into the ellipsoid's axes
};

/// Round cones joined end to end along a polyline: exact distance to their union. Made by
/// tube_through.
struct Tube {
  std::vector<Vec3> points;
  std::vector<double> radii;  ///< one a point
  std::vector<double> reach;  ///< of cone i: no point of it is farther from points[i]
};

/// Tube along the Catmull-Rom curve through points of given radii (E. Catmull, R. Rom, "A class of
/// local interpolating splines", 1974; uniform, its ends reflected), in steps of a sixth of a span.
/// Two points make one straight round cone.
Tube tube_through(const std::vector<Vec3>& points, const std::vector<double>& radii);

/// Sets `reach` anew after points or radii were changed.
void find_reach(Tube& tube);

/// Box with rounded edges, `half` including the rounding.
struct RoundedBox {
  Vec3 center = Vec3::Zero();
  Vec3 half = Vec3::Ones();
  double round = 0;
  Mat3 R_local = Mat3::Identity();
};

/// All points behind the plane through `point` whose normal is `normal`. Cuts only.
struct HalfSpace {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

/// Rough slit: all that lies within half of `gap`, measured along `normal`, of a bumpy sheet about
/// the plane through `point`. Cuts only. Its value is at most the distance.
struct Crack {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  double gap = 0;
  double rough = 0;  ///< the sheet lies at most this far off the plane
  double grain = 1;  ///< width of a bump
};

using Primitive = std::variant<Ellipsoid, Tube, RoundedBox, HalfSpace, Crack>;

double distance(const Ellipsoid& e, const Vec3& p);
double distance(const Tube& t, const Vec3& p);
/// Of the cones from `first` until before `last`.
double distance(const Tube& t, const Vec3& p, std::size_t first, std::size_t last);
/// Narrows the range to one that holds all its cones that are farther from p than the nearest by at
/// most `more`; returns the distance to that one.
double narrow_cones(const Tube& t, const Vec3& p, double more, std::uint32_t& first,
                    std::uint32_t& last);
double distance(const RoundedBox& b, const Vec3& p);
double distance(const HalfSpace& h, const Vec3& p);
double distance(const Crack& c, const Vec3& p);
double distance(const Primitive& primitive, const Vec3& p);

/// Box that holds the primitive; empty for a half-space and a crack, which have no end.
Aabb bounds(const Primitive& primitive);

/// Largest ratio of a primitive's value to the true distance (1 where the value is exact).
double stretch(const Primitive& primitive);

/// Polynomial smooth minimum: equals min(a, b) where they differ by `k` or more, else lower by up
/// to k / 4 (I. Quilez, "Smooth minimum", quadratic form).
double smooth_min(double a, double b, double k);
double smooth_max(double a, double b, double k);

enum class Operation { kAdd, kCut };

struct Part {
  Operation operation = Operation::kAdd;
  Primitive primitive;
  double blend = 0;       ///< radius of the smooth join, metres
  std::string name = {};  ///< may be empty; variation tables act on parts by it
};

/// Parts folded in their order: each is joined to, or cut from, all before it.
struct Solid {
  std::vector<Part> parts;
};

double distance(const Solid& solid, const Vec3& p);
/// What is left of a body of value `d` at `p` when `cut` is taken from it.
double less(double d, const Part& cut, const Vec3& p);
Aabb bounds(const Solid& solid);
double stretch(const Solid& solid);

/// Rotation by angles in degrees about x, then y, then z (all fixed axes). Its sines and cosines
/// are computed here, since those of the C library may differ between machines in the last bit.
Mat3 rotation_xyz_deg(const Vec3& angles_deg);

}  // namespace osteon
