#pragma once

#include <cmath>
#include <limits>

#include "nearest_simplex.h"
#include "osteon/base/types.h"

namespace osteon {

/// Where the distance of two convex bodies was found.
struct DistanceSearch {
  NearestSimplex simplex;
  Vec3 v = Vec3::Zero();  ///< shortest vector from the second body to the first
  double distance = 0;
  int steps = 0;
  bool ended = false;  ///< within the number of steps
};

/// Gilbert, Johnson and Keerthi (1988). Symbols: v is the point of the hull of `simplex` nearest to
/// the origin, in the difference of the bodies; farthest(v) is a point of the difference that lies
/// farthest against v. Invariant: |v| falls with each step. It ends when no point lies farther
/// against v by more than rounding. False when the bodies meet: nearer than `touching`. Where `out`
/// has a simplex of the bodies as they are, the search goes on from it and not from v.
template <class Farthest>
bool search_distance(Vec3 v, double touching, const Farthest& farthest, DistanceSearch& out) {
  constexpr int kMostSteps = 100;
  constexpr double kRelative = 1e-12;  // of the squared distance: when the search ends
  double square = std::numeric_limits<double>::infinity();
  if (out.simplex.count > 0) {
    v = out.simplex.nearest();
    square = v.squaredNorm();
    if (square <= touching * touching) return false;
  }
  if (!(v.squaredNorm() > 0)) v = Vec3::UnitX();
  for (; out.steps < kMostSteps; ++out.steps) {
    const DifferencePoint w = farthest(v);
    if (out.simplex.count > 0 && square - v.dot(w.w) <= kRelative * square) break;
    NearestSimplex next = out.simplex;
    if (add_point(next, w)) return false;
    const Vec3 nearer = next.nearest();
    if (!(nearer.squaredNorm() < square)) break;  // rounding: the last one was the nearest
    out.simplex = next;
    v = nearer;
    square = v.squaredNorm();
    if (square <= touching * touching) return false;
  }
  out.v = v;
  out.distance = std::sqrt(square);
  out.ended = out.steps < kMostSteps;
  return true;
}

}  // namespace osteon
