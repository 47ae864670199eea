#include <gtest/gtest.h>

#include "collide/shapes.h"
#include "osteon/base/hash.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {
namespace {

using shapes::body;

std::vector<ConvexBody> bodies() {
  Random random(7);
  std::vector<ConvexBody> all = {body(shapes::box({0.01, 0.02, 0.005})),
                                 body(shapes::octahedron({0.01, 0.01, 0.02})),
                                 body(shapes::cone(20, 0.002, 0.03)),
                                 body(shapes::ellipsoid(2, {0.01, 0.015, 0.03})),
                                 body(shapes::ellipsoid(3, {0.02, 0.004, 0.004})),
                                 body(shapes::box({1e-5, 0.02, 0.02}))};
  for (int i = 0; i < 6; ++i)
    all.push_back(body(shapes::random_hull(random, 6 + i, {0.01, 0.02, 0.01})));
  return all;
}

struct Pair {
  const ConvexBody& a;
  const ConvexBody& b;
  Pose X_AB;
};

template <class Check>
void for_random_pairs(int count, std::uint64_t seed, const Check& check) {
  static const std::vector<ConvexBody> all = bodies();
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const ConvexBody& a = all[random.next() % all.size()];
    const ConvexBody& b = all[random.next() % all.size()];
    check(Pair{a, b, shapes::random_pose(random, 1.1 * (a.radius + b.radius))}, random);
  }
}

// Largest violation of the depth programme's rows at (x, t), by going through all of them.
double violation(const Pair& p, const Vec3& x_A, double t) {
  const Vec3 x_B = p.X_AB.inverse() * x_A;
  double worst = -1;
  for (std::uint32_t i = 0; i < p.a.plane_count; ++i)
    worst = std::max(worst, p.a.normal(i).dot(x_A) - p.a.d[i] - t);
  for (std::uint32_t i = 0; i < p.b.plane_count; ++i)
    worst = std::max(worst, p.b.normal(i).dot(x_B) - p.b.d[i] - t);
  return worst;
}

// Weak duality: feasible weights of the basis' rows bound t from below.
double lower_bound(const Pair& p, const LpBasis& basis) {
  Eigen::Matrix4d m;
  Eigen::Vector4d d;
  for (int k = 0; k < 4; ++k) {
    const std::uint32_t id = basis.rows[static_cast<std::size_t>(k)];
    const bool of_a = id < p.a.plane_count;
    const std::uint32_t i = of_a ? id : id - p.a.plane_count;
    const Vec3 n = of_a ? p.a.normal(i) : p.X_AB.rotate(p.b.normal(i));
    m.col(k) << n, 1.0;
    d[k] = of_a ? p.a.d[i] : p.b.d[i] + n.dot(p.X_AB.p);
  }
  const Eigen::Vector4d y = m.fullPivLu().solve(Eigen::Vector4d(0, 0, 0, 1));
  EXPECT_GE(y.minCoeff(), -1e-9);
  return -y.dot(d);
}

TEST(LpContactProperty, OptimumIsFeasibleAndItsWeightsProveIt) {
  for_random_pairs(3000, 31, [](const Pair& p, Random&) {
    LpBasis basis;
    const LpDepth r = lp_depth(p.a, p.b, p.X_AB, &basis);
    ASSERT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_LE(violation(p, r.p_A, r.t), 1e-12);
    EXPECT_LE(r.residual, 1e-12);
    EXPECT_NEAR(lower_bound(p, basis), r.t, 1e-11);
  });
}

TEST(LpContactProperty, GapPartsTheBodies) {
  for_random_pairs(2000, 37, [](const Pair& p, Random&) {
    const LpDepth r = lp_depth(p.a, p.b, p.X_AB);
    EXPECT_EQ(r.gap > 0, r.t > 0);
    // A ball of radius -t fits into the overlap; bodies t from a common point are 2 t apart.
    EXPECT_LE((r.gap - 2 * r.t) * (r.t > 0 ? -1 : 1), 1e-12);
    Pose moved = p.X_AB;
    moved.p += (1e-9 - r.gap) * r.nhat_AB_A;
    EXPECT_FALSE(lp_test(p.a, p.b, moved).hit);
  });
}

TEST(LpContactProperty, PointOfAHitLiesInBoth) {
  int hits = 0;
  for_random_pairs(2000, 41, [&](const Pair& p, Random&) {
    const LpHit hit = lp_test(p.a, p.b, p.X_AB);
    EXPECT_EQ(hit.status, hit.hit ? LpStatus::kOptimal : LpStatus::kUnbounded);
    if (!hit.hit) return;
    ++hits;
    EXPECT_LE(violation(p, hit.p_A, 0), 1e-12);
    // It is the point of largest x + y + z: the inscribed ball's centre is none larger.
    EXPECT_LE(lp_depth(p.a, p.b, p.X_AB).p_A.sum(), hit.p_A.sum() + 1e-12);
  });
  EXPECT_GT(hits, 400);
}

TEST(LpContactProperty, SwappingTheBodiesTurnsTheNormal) {
  for_random_pairs(2000, 43, [](const Pair& p, Random&) {
    const LpDepth r = lp_depth(p.a, p.b, p.X_AB);
    const LpDepth s = lp_depth(p.b, p.a, p.X_AB.inverse());
    EXPECT_NEAR(s.t, r.t, 1e-12);
    EXPECT_NEAR(s.gap, r.gap, 1e-9);
    EXPECT_NEAR((p.X_AB.rotate(s.nhat_AB_A) + r.nhat_AB_A).norm(), 0, 1e-6);
    EXPECT_EQ(lp_test(p.b, p.a, p.X_AB.inverse()).hit, r.t <= 0);
  });
}

// Moving both bodies leaves depth, gap and normal as they are.
TEST(LpContactProperty, RigidMotionChangesNothing) {
  Random shape(3);
  const Hull ha = shapes::random_hull(shape, 12, {0.01, 0.02, 0.01});
  const Hull hb = shapes::random_hull(shape, 9, {0.01, 0.005, 0.01});
  const ConvexBody a = body(ha), b = body(hb);
  Random random(47);
  for (int i = 0; i < 500; ++i) {
    const Pose X_AB = shapes::random_pose(random, 0.03);
    const Pose X_WA = shapes::random_pose(random, 2.0);
    Hull moved = ha;
    for (Vec3& v : moved.vertices) v = X_WA * v;
    for (Plane& plane : moved.planes) {
      const Vec3 n = X_WA.rotate(plane.n);
      plane = {n, plane.d + n.dot(X_WA.p)};
    }
    const LpDepth r = lp_depth(a, b, X_AB);
    const LpDepth s = lp_depth(body(moved), b, X_WA * X_AB);
    EXPECT_NEAR(s.t, r.t, 1e-9);
    EXPECT_NEAR(s.gap, r.gap, 1e-9);
    EXPECT_NEAR((s.nhat_AB_A - X_WA.rotate(r.nhat_AB_A)).norm(), 0, 1e-9);
  }
}

TEST(LpContactProperty, PushingInDeepensMonotonically) {
  const ConvexBody block = body(shapes::box({0.05, 0.05, 0.05}));
  Random random(53);
  for (int i = 0; i < 100; ++i) {
    const ConvexBody b = body(shapes::random_hull(random, 10, {0.004, 0.004, 0.008}));
    const Quat turn = random.rotation();
    double t = 1, gap = 1;
    for (int step = 0; step < 60; ++step) {
      const LpDepth r = lp_depth(block, b, {Vec3(0.01, 0.005, 0.06 - step * 3e-4), turn});
      ASSERT_EQ(r.status, LpStatus::kOptimal);
      EXPECT_LE(r.t, t + 1e-12);
      EXPECT_LE(r.gap, gap + 1e-12);
      t = r.t;
      gap = r.gap;
    }
    EXPECT_LT(gap, -1e-3);
  }
}

TEST(LpContactProperty, WarmEqualsColdAlongAPath) {
  const ConvexBody bone = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const ConvexBody probe = body(shapes::cone(16, 0.0015, 0.02));
  Random random(59);
  LpBasis warm, test;
  long cold_pivots = 0, warm_pivots = 0;
  Pose X_AB{Vec3(0, 0, 0.0395), Quat::Identity()};
  for (int i = 0; i < 4000; ++i) {
    const Vec3 step = 2e-4 * random.direction();
    const Vec3 axis = random.direction();
    X_AB.p += step;
    if (X_AB.p.cwiseQuotient(Vec3(0.01, 0.015, 0.04)).norm() > 1.1) X_AB.p -= 2 * step;
    X_AB.q = (X_AB.q * Quat(Eigen::AngleAxisd(0.01, axis))).normalized();
    const LpDepth c = lp_depth(bone, probe, X_AB);
    const LpDepth w = lp_depth(bone, probe, X_AB, &warm);
    ASSERT_EQ(w.status, LpStatus::kOptimal);
    EXPECT_NEAR(w.t, c.t, 1e-12);
    EXPECT_NEAR(w.gap, c.gap, 1e-9);
    EXPECT_EQ(lp_test(bone, probe, X_AB, &test).hit, c.t <= 0);
    cold_pivots += c.pivots;
    warm_pivots += w.pivots;
  }
  EXPECT_LT(warm_pivots, cold_pivots / 2);
}

// The same bits from every compiler and build type: recordings replay on this.
TEST(LpContactProperty, SameBitsOnEveryBuild) {
  const ConvexBody bone = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const ConvexBody probe = body(shapes::ellipsoid(1, {0.0015, 0.0015, 0.006}));
  Random random(67);
  Hasher hash;
  LpBasis warm, test;
  for (int i = 0; i < 2000; ++i) {
    Pose X_AB;
    for (int k = 0; k < 3; ++k) X_AB.p[k] = random.uniform(-0.02, 0.02);
    for (int k = 0; k < 4; ++k) X_AB.q.coeffs()[k] = random.uniform(-1, 1);
    X_AB.q.normalize();
    const LpDepth r = lp_depth(bone, probe, X_AB, &warm);
    const LpHit h = lp_test(bone, probe, X_AB, &test);
    for (const double v : {r.t, r.gap, r.residual}) hash.add(v);
    hash.add(r.nhat_AB_A);
    hash.add(r.p_A);
    hash.add(h.p_A);
    hash.add(r.pivots + 1000 * h.pivots);
  }
  EXPECT_EQ(hash.value(), 0xb74c69b51a495677ull) << std::hex << hash.value();
}

// Grids of equal boxes: every optimum is degenerate, many planes pass through every vertex.
TEST(LpContactProperty, DegenerateStacksEnd) {
  const ConvexBody cube = body(shapes::box({0.01, 0.01, 0.01}));
  const ConvexBody diamond = body(shapes::octahedron({0.01, 0.01, 0.01}));
  LpBasis warm_cube, warm_diamond, test;
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z)
        for (const double w : {0.0, 1.0}) {
          const Pose X_AB{Vec3(x, y, z) * 0.005, Quat(1 - w, w, 0, 0)};
          const LpDepth r = lp_depth(cube, cube, X_AB, &warm_cube);
          ASSERT_EQ(r.status, LpStatus::kOptimal);
          const double away = std::max({std::abs(x), std::abs(y), std::abs(z)}) * 0.005;
          EXPECT_NEAR(r.t, (away - 0.02) / 2, 1e-12);
          EXPECT_EQ(lp_test(cube, cube, X_AB, &test).hit, away <= 0.02);
          const LpDepth d = lp_depth(cube, diamond, X_AB, &warm_diamond);
          ASSERT_EQ(d.status, LpStatus::kOptimal);
          EXPECT_NEAR(d.t, lp_depth(cube, diamond, X_AB).t, 1e-12);
          EXPECT_EQ(lp_test(cube, diamond, X_AB).hit, d.t <= 1e-15);
        }
}

}  // namespace
}  // namespace osteon
