#pragma once

#include "osteon/collide/lp_contact.h"

namespace osteon {

/// Of the pair along a unit direction of A's frame.
struct GapAlong {
  double gap = 0;    ///< smallest height of B less largest of A, m
  double top_A = 0;  ///< largest height of A, m
};
GapAlong gap_along(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, const Vec3& nhat_A);

/// The same, looked for in `near` first; with `list_anew` lists that do not serve are made anew.
GapAlong gap_along(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, const Vec3& nhat_A,
                   LpNear& near, bool list_anew);

struct Separation {
  Vec3 nhat_AB_A = Vec3::UnitZ();
  double gap = 0;
};

/// The facet normal of A, or reversed facet normal of B, along which the gap is largest (the
/// overlap least). The gap is continuous in the pose. Visits every facet: for one body deep inside
/// the other only.
Separation least_overlap_facet(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB);

}  // namespace osteon
