#include "commands/shapes/collide_table.h"

#include <algorithm>
#include <cstdio>

#include "osteon/base/clock.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {
namespace {

bool answered(const LpHit& hit) {
  return hit.status == LpStatus::kOptimal || hit.status == LpStatus::kUnbounded;
}

std::string line(const LpHit& hit, const LpDepth& depth, std::int64_t ns) {
  const double depth_mm = hit.hit ? std::max(0.0, -depth.gap) * 1e3 : 0.0;
  const Vec3& n = depth.nhat_AB_A;
  const Vec3 p_mm = depth.p_A * 1e3;
  char text[400];
  std::snprintf(text, sizeof text, "%d,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%d,%lld\n",
                hit.hit ? 1 : 0, depth_mm, n.x(), n.y(), n.z(), p_mm.x(), p_mm.y(), p_mm.z(),
                hit.pivots + depth.pivots, static_cast<long long>(ns));
  return text;
}

}  // namespace

Result<CollideTable> make_collide_table(const ConvexBody& a, const ConvexBody& b,
                                        std::span<const Pose> X_AB) {
  CollideTable table;
  table.csv = "hit,depth_mm,nx,ny,nz,px_mm,py_mm,pz_mm,pivots,ns\n";
  LpBasis test_basis, depth_basis;
  for (const Pose& X : X_AB) {
    const std::int64_t start = steady_now_ns();
    const LpHit hit = lp_test(a, b, X, &test_basis);
    const LpDepth depth = lp_depth(a, b, X, &depth_basis);
    const std::int64_t ns = steady_now_ns() - start;
    ++table.poses;
    if (!answered(hit) || depth.status != LpStatus::kOptimal)
      return fail("the contact solver found no answer", "pose " + std::to_string(table.poses),
                  "Check that the meshes are not slivers and that the pose is close to them");
    table.hits += hit.hit;
    table.times.add_ns(ns);
    table.csv += line(hit, depth, ns);
  }
  return table;
}

}  // namespace osteon
