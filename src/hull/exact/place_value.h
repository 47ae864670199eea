#pragma once

#include <algorithm>

#include "facet_table.h"
#include "osteon/mesh/joint_ends.h"

namespace osteon::hull {

/// What a place counts when pieces are shared out.
struct PlaceValue {
  JointEnds ends;
  double on_shaft = 1;  ///< elsewhere 1
  double at(const Vec3& p) const { return on_shaft < 1 && ends.on_shaft(p) ? on_shaft : 1; }
  /// Most that a place of the triangle counts.
  double most(const Corners& t) const { return std::max({at(t[0]), at(t[1]), at(t[2])}); }
};

/// Where a hull stands highest over the mesh, by what places count.
struct Peak {
  double need = 0;         ///< the height times what its place counts, m
  double height = 0;       ///< m
  Vec3 at = Vec3::Zero();  ///< on the hull
  /// Takes a higher one.
  void raise(double new_need, double new_height, const Vec3& p) {
    if (new_need <= need) return;
    need = new_need;
    height = new_height;
    at = p;
  }
};

}  // namespace osteon::hull
