#include "separation.h"

#include <limits>

#include "near_search.h"

namespace osteon {
namespace {

// Best facet of `a`, starting from a gap to beat. B's centre lies inside B, so that no facet can do
// better than the centre's height over it: most facets are dismissed by that alone.
bool improve(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, double& best,
             std::uint32_t& facet) {
  const Vec3 center_A = X_AB * b.center;
  bool improved = false;
  for (std::uint32_t i = 0; i < a.plane_count; ++i) {
    const Vec3 n = a.normal(i);
    if (n.dot(center_A) - a.d[i] <= best) continue;
    const double gap = gap_along(a, b, X_AB, n).gap;
    if (gap <= best) continue;
    best = gap;
    facet = i;
    improved = true;
  }
  return improved;
}

}  // namespace

GapAlong gap_along(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, const Vec3& nhat_A) {
  const Vec3 n_B = X_AB.q.conjugate() * nhat_A;
  const double top_A = support(a, nhat_A);
  return {-(top_A + (support(b, -n_B) - nhat_A.dot(X_AB.p))), top_A};
}

GapAlong gap_along(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, const Vec3& nhat_A,
                   LpNear& near, bool list_anew) {
  const Vec3 n_B = X_AB.q.conjugate() * nhat_A;
  const double top_A = support(a, nhat_A, near.vertices_a);
  const double top_B = support(b, -n_B, near.vertices_b);
  if (list_anew) {
    list_vertices(a, nhat_A, top_A, near.vertices_a);
    list_vertices(b, -n_B, top_B, near.vertices_b);
  }
  return {-(top_A + (top_B - nhat_A.dot(X_AB.p))), top_A};
}

Separation least_overlap_facet(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB) {
  Separation out;
  out.gap = -std::numeric_limits<double>::infinity();
  std::uint32_t facet = 0;
  if (improve(a, b, X_AB, out.gap, facet)) out.nhat_AB_A = a.normal(facet);
  if (improve(b, a, X_AB.inverse(), out.gap, facet)) out.nhat_AB_A = -(X_AB.q * b.normal(facet));
  return out;
}

}  // namespace osteon
