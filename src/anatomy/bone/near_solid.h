#pragma once

#include <cstdint>
#include <vector>

#include "describe/shape.h"

namespace osteon {

/// A small place.
struct Vicinity {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

/// Between which all values of a field lie in a vicinity.
struct Spread {
  double least = -1e300, most = 1e300;

  /// 1 or -1 where all values have that sign, else 0.
  int sign() const { return least > 0 ? 1 : (most < 0 ? -1 : 0); }
};

/// The spread of a primitive's values. Exact distances change by no more than the way; an
/// ellipsoid's value f = k0 (k0 - 1) / k1 (shape.h) changes by at most |2 - 1 / k0| +
/// K |1 - 1 / k0| times the way, where K bounds k0^2 |grad k1| / k1^2: with radii from a to b and
/// c = 1 + (b / a)^2 + (b / a)^4 it is K^2 = 4 c^3 / (27 (c - 1)^2).
Spread spread(const Primitive& primitive, const Vicinity& where);

/// Adding and cutting, of spreads. Both grow with either value, so the ends fold by themselves.
Spread smooth_min(const Spread& a, const Spread& b, double k);
Spread smooth_max(const Spread& a, const Spread& b, double k);
/// True where smooth_min gives the values of `a` themselves throughout, whatever the rounding.
bool surely_less(const Spread& a, const Spread& b, double k);
Spread negated(const Spread& s);

/// The parts of a solid that decide its value in a vicinity: everywhere, at first. The solid must
/// live longer.
class NearSolid {
 public:
  NearSolid() = default;
  explicit NearSolid(const Solid& solid);
  /// Of parts in this order, the first of which is added.
  explicit NearSolid(const std::vector<const Part*>& parts);

  /// distance(solid, p), bit by bit.
  double operator()(const Vec3& p) const;

  /// Narrowed to a vicinity that lies in the one before; tells the spread of the values there.
  NearSolid within(const Vicinity& where, Spread& values) const;

 private:
  struct NearPart {
    const Part* part;
    bool cuts;
    std::uint32_t first, last;  ///< cones, where it is a tube
  };
  void add(const Part& part);
  static double value(const NearPart& near, const Vec3& p);
  static Spread narrow(NearPart& near, const Vicinity& where);

  std::vector<NearPart> parts_;
};

}  // namespace osteon
