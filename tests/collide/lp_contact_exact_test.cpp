// Hit or miss against exact arithmetic. A verdict counts when a proof checks out with integers: a
// point of both bodies, or a direction that parts them. The proofs are proposed by lp_depth, but
// are worth nothing unless they check out; pairs without one go to CGAL's exact solver.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "collide/exact_programme.h"
#include "collide/shapes.h"
#include "osteon/base/turn.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {
namespace {

constexpr double kNearTouching = 1e-9;  // m

struct Sample {
  Hull hull;
  ConvexBody body;
  exact::Body judged;
};

Sample snapped(Hull hull) {
  for (Vec3& v : hull.vertices) v = exact::snap(v, exact::kLengthBits);
  for (std::size_t i = 0; i < hull.triangles.size(); ++i) {
    const auto& t = hull.triangles[i];
    hull.planes[hull.plane_of[i]] =
        shapes::plane_through(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]);
  }
  Sample s{hull, shapes::body(hull), exact::body(hull)};
  EXPECT_TRUE(exact::is_convex(s.judged));
  return s;
}

std::vector<Sample> make_samples() {
  Random random(101);
  std::vector<Sample> all;
  for (int i = 0; i < 40; ++i) {
    const double wide = random.uniform(0.001, 0.02);
    const double tall = random.uniform(0.001, 0.02);
    all.push_back(snapped(shapes::random_hull(random, 4 + i % 13, {wide, tall, 0.01})));
  }
  all.push_back(snapped(shapes::box({0.01, 0.01, 0.01})));
  all.push_back(snapped(shapes::box({0.0001, 0.01, 0.02})));
  all.push_back(snapped(shapes::octahedron({0.01, 0.01, 0.02})));
  all.push_back(snapped(shapes::octahedron({0.0001, 0.0001, 0.02})));
  all.push_back(snapped(shapes::box({0.02, 0.00001, 0.02})));
  all.push_back(snapped(shapes::octahedron({0.00001, 0.00001, 0.02})));
  return all;
}

Pose judged_pose(Random& random, const Sample& a, const Sample& b, int i) {
  Pose X_AB = exact::snap(shapes::random_pose(random, 1.2 * (a.body.radius + b.body.radius)));
  if (i % 4 != 0) return X_AB;
  // Every fourth pair is brought close to touching: 1e-5 to 1e-12 m apart or overlapping.
  const LpDepth r = lp_depth(a.body, b.body, X_AB);
  const double gap = (i % 8 == 0 ? 1 : -1) * std::pow(10.0, random.uniform(-12, -5));
  X_AB.p += (gap - r.gap) * r.nhat_AB_A;
  return exact::snap(X_AB);
}

Vec3 edge(const Sample& s, Random& random, Vec3& middle) {
  const Triangle& t = s.hull.triangles[random.next() % s.hull.triangles.size()];
  const Vec3 &p = s.hull.vertices[t[0]], &q = s.hull.vertices[t[1]];
  middle = 0.5 * (p + q);
  return (q - p).normalized();
}

// A place on a facet and the facet's normal.
Vec3 facet(const Sample& s, Random& random, Vec3& normal) {
  const std::size_t i = random.next() % s.hull.triangles.size();
  const Triangle& t = s.hull.triangles[i];
  normal = s.hull.planes[s.hull.plane_of[i]].n;
  const double u = random.uniform(0.1, 0.5);
  const double v = random.uniform(0.1, 0.4);
  return (1 - u - v) * s.hull.vertices[t[0]] + u * s.hull.vertices[t[1]] +
         v * s.hull.vertices[t[2]];
}

enum class Touch {
  kCorners,  // a corner on a corner
  kCornerOnFacet,
  kEdges,  // two that cross
  kParallelEdges,
  kFacets,   // parallel, overlapping
  kAligned,  // facets on facets without a turn: parallel to the last bit
  kDeep,     // one middle in the other
  kCount
};

// B so that the two places coincide, turned as asked, and a little more apart along n_A.
Pose brought_together(const Vec3& p_A, const Vec3& p_B, const Quat& q_AB, const Vec3& n_A,
                      double apart) {
  return {p_A - q_AB * p_B + apart * n_A, q_AB};
}

// The two touch there, or miss or overlap by 1e-12 to 1e-6 m; of the last kind they overlap deeply.
Pose adversarial_pose(Random& random, const Sample& a, const Sample& b, Touch touch) {
  const double size = random.next() % 3 == 0 ? 0 : std::pow(10.0, random.uniform(-12, -6));
  const double apart = random.next() % 2 == 0 ? size : -size;
  const Quat any = random.rotation();
  Vec3 n_A, n_B, p_A, p_B;
  const Vec3 on_a = facet(a, random, n_A);
  const Vec3 on_b = facet(b, random, n_B);
  const Quat facing = turn_between(n_B, -n_A);
  const Vec3& corner_a = a.hull.vertices[random.next() % a.hull.vertices.size()];
  const Vec3& corner_b = b.hull.vertices[random.next() % b.hull.vertices.size()];
  switch (touch) {
    case Touch::kCorners:
      return brought_together(corner_a, corner_b, any, corner_a.normalized(), apart);
    case Touch::kCornerOnFacet:
      return brought_together(on_a, corner_b, facing, n_A, apart);
    case Touch::kEdges:
      edge(a, random, p_A);
      edge(b, random, p_B);
      return brought_together(p_A, p_B, turn_between(p_B, -p_A), p_A.normalized(), apart);
    case Touch::kParallelEdges: {
      const Vec3 along_a = edge(a, random, p_A);
      const Vec3 along_b = edge(b, random, p_B);
      return brought_together(p_A, p_B, turn_between(along_b, along_a), p_A.normalized(), apart);
    }
    case Touch::kFacets:
      return brought_together(on_a, on_b, facing, n_A, apart);
    case Touch::kAligned:
      return brought_together(on_a, on_b, Quat::Identity(), n_A, apart);
    default:
      return brought_together(a.body.center, b.body.center, any, n_A, 0);
  }
}

struct Tally {
  int hits = 0, misses = 0, near_touching = 0, without_proof = 0, wrong = 0, wrong_near = 0;
  int not_optimal = 0;
};

bool judge(const Sample& a, const Sample& b, const Pose& X_AB, const LpDepth& r, Tally& tally) {
  const exact::Turn turn(X_AB);
  if (exact::proves_hit(a.judged, b.judged, turn, r.p_A)) return true;
  if (exact::proves_miss(a.judged, b.judged, turn, r.nhat_AB_A)) return false;
  ++tally.without_proof;
  return exact::solve_hit(a.judged, b.judged, turn);
}

void try_pair(const Sample& a, const Sample& b, const Pose& X_AB, Tally& tally) {
  const LpHit hit = lp_test(a.body, b.body, X_AB);
  const LpDepth depth = lp_depth(a.body, b.body, X_AB);
  if (depth.status != LpStatus::kOptimal ||
      (hit.status != LpStatus::kOptimal && hit.status != LpStatus::kUnbounded))
    ++tally.not_optimal;
  const bool truth = judge(a, b, X_AB, depth, tally);
  ++(truth ? tally.hits : tally.misses);
  const bool near = std::abs(depth.t) < kNearTouching;
  tally.near_touching += near;
  const bool wrong = hit.hit != truth || (!near && (depth.t <= 0) != truth);
  (near ? tally.wrong_near : tally.wrong) += wrong;
}

// Of each of the two large tests; tools/test --long asks for a million in all.
int wanted_pairs() {
  const char* set = std::getenv("OSTEON_ORACLE_PAIRS");
  return set ? std::atoi(set) : 100000;
}

TEST(LpContactExact, HitOrMissOfRandomPairs) {
  const std::vector<Sample> samples = make_samples();
  Random random(202);
  Tally tally;
  const int pairs = wanted_pairs();
  for (int i = 0; i < pairs; ++i) {
    const Sample& a = samples[random.next() % samples.size()];
    const Sample& b = samples[random.next() % samples.size()];
    try_pair(a, b, judged_pose(random, a, b, i), tally);
  }
  std::cout << pairs << " pairs: " << tally.hits << " hits, " << tally.misses << " misses; "
            << tally.near_touching << " within 1e-9 m of touching (" << tally.wrong_near
            << " of them judged otherwise); " << tally.without_proof
            << " went to the exact solver\n";
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.not_optimal, 0);
  EXPECT_GT(tally.hits, pairs / 10);
  EXPECT_GT(tally.misses, pairs / 10);
  EXPECT_LT(tally.near_touching, pairs / 4);
}

TEST(LpContactExact, HitOrMissOfTouchingAndDeepPairs) {
  const std::vector<Sample> samples = make_samples();
  Random random(404);
  const int pairs = wanted_pairs();
  const int kinds = static_cast<int>(Touch::kCount);
  for (int kind = 0; kind < kinds; ++kind) {
    Tally tally;
    for (int i = 0; i < pairs / kinds; ++i) {
      const Sample& a = samples[random.next() % samples.size()];
      const Sample& b = samples[random.next() % samples.size()];
      const Pose X_AB = adversarial_pose(random, a, b, static_cast<Touch>(kind));
      try_pair(a, b, exact::snap(X_AB), tally);
    }
    std::cout << "kind " << kind << ": " << tally.hits << " hits, " << tally.misses << " misses; "
              << tally.near_touching << " within 1e-9 m of touching (" << tally.wrong_near
              << " of them judged otherwise); " << tally.without_proof
              << " went to the exact solver\n";
    EXPECT_EQ(tally.wrong, 0) << kind;
    EXPECT_EQ(tally.not_optimal, 0) << kind;
    EXPECT_GT(tally.hits, pairs / kinds / 20) << kind;
  }
}

TEST(LpContactExact, AgreesWithAnExactSolver) {
  const std::vector<Sample> samples = make_samples();
  Random random(303);
  int hits = 0;
  for (int i = 0; i < 150; ++i) {
    const Sample& a = samples[random.next() % samples.size()];
    const Sample& b = samples[random.next() % samples.size()];
    const Pose X_AB = judged_pose(random, a, b, i);
    const LpDepth depth = lp_depth(a.body, b.body, X_AB);
    if (std::abs(depth.t) < kNearTouching) continue;
    const bool truth = exact::solve_hit(a.judged, b.judged, exact::Turn(X_AB));
    EXPECT_EQ(lp_test(a.body, b.body, X_AB).hit, truth) << i << " t " << depth.t;
    EXPECT_EQ(depth.t <= 0, truth) << i << " t " << depth.t;
    hits += truth;
  }
  EXPECT_GT(hits, 20);
  EXPECT_LT(hits, 130);
}

}  // namespace
}  // namespace osteon
