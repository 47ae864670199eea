// Hulls of real bones, when the reference anatomy is there: hundreds of facets, many nearly
// parallel, coordinates far from the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "collide/exact_programme.h"
#include "collide/shapes.h"
#include "osteon/collide/lp_contact.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

struct Bone {
  ConvexBody body;
  exact::Body judged;
};

fs::path wrist_dir() {
  const char* shared = std::getenv("OSTEON_SHARED");
  return fs::path(shared ? shared : OSTEON_SOURCE_DIR "/../shared") / "anatomy" / "wrist";
}

std::vector<Bone> load_bones() {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(wrist_dir(), none))
    if (entry.path().extension() == ".stl") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bone> bones;
  for (const fs::path& file : files) {
    auto mesh = load_mesh(file, 1.0);
    EXPECT_TRUE(mesh) << file;
    for (Vec3& v : mesh->vertices) v = exact::snap(v, exact::kLengthBits);
    const HullOutcome outcome = build_hull(mesh->vertices);
    EXPECT_TRUE(outcome.hull) << file;
    bones.push_back({shapes::body(*outcome.hull), exact::body(*outcome.hull)});
    EXPECT_TRUE(exact::is_convex(bones.back().judged)) << file;
  }
  return bones;
}

// B's centre at a random place about A's, every other pair brought within 0.1 mm of touching.
Pose near_pose(Random& random, const Bone& a, const Bone& b, int i) {
  const Pose about = shapes::random_pose(random, 1.1 * (a.body.radius + b.body.radius));
  Pose X_AB{a.body.center + about.p - about.rotate(b.body.center), about.q};
  const double gap = random.uniform(-1e-4, 1e-4);
  if (i % 2 == 0) {
    const LpDepth r = lp_depth(a.body, b.body, X_AB);
    X_AB.p += (gap - r.gap) * r.nhat_AB_A;
  }
  return exact::snap(X_AB);
}

bool truth(const Bone& a, const Bone& b, const Pose& X_AB, const LpDepth& r, int& unproved) {
  const exact::Turn turn(X_AB);
  if (exact::proves_hit(a.judged, b.judged, turn, r.p_A)) return true;
  if (exact::proves_miss(a.judged, b.judged, turn, r.nhat_AB_A)) return false;
  ++unproved;
  return exact::solve_hit(a.judged, b.judged, turn);
}

TEST(LpContactBones, HitOrMissIsExactAndWarmEqualsCold) {
  const std::vector<Bone> bones = load_bones();
  if (bones.empty()) GTEST_SKIP() << "the reference wrist is not there";
  Random random(71);
  int hits = 0, unproved = 0, near = 0;
  long pivots = 0;
  LpBasis depth_basis, test_basis;
  constexpr int kPairs = 1500;
  for (int i = 0; i < kPairs; ++i) {
    const Bone& a = bones[random.next() % bones.size()];
    const Bone& b = bones[random.next() % bones.size()];
    const Pose X_AB = near_pose(random, a, b, i);
    const LpDepth cold = lp_depth(a.body, b.body, X_AB);
    const LpDepth warm = lp_depth(a.body, b.body, X_AB, &depth_basis);  // of another pair
    ASSERT_EQ(cold.status, LpStatus::kOptimal);
    ASSERT_EQ(warm.status, LpStatus::kOptimal);
    EXPECT_NEAR(warm.t, cold.t, 1e-12);
    pivots += cold.pivots;
    if (std::abs(cold.t) < 1e-9) {
      ++near;
      continue;
    }
    const bool hit = truth(a, b, X_AB, cold, unproved);
    EXPECT_EQ(lp_test(a.body, b.body, X_AB).hit, hit);
    EXPECT_EQ(lp_test(a.body, b.body, X_AB, &test_basis).hit, hit);
    EXPECT_EQ(cold.t <= 0, hit);
    hits += hit;
  }
  std::cout << bones.size() << " bones, " << kPairs << " pairs: " << hits << " hits, " << near
            << " within 1e-9 m of touching, " << unproved << " went to the exact solver; "
            << static_cast<double>(pivots) / kPairs << " pivots from cold\n";
  EXPECT_GT(hits, kPairs / 10);
  EXPECT_LT(hits, kPairs * 9 / 10);
}

}  // namespace
}  // namespace osteon
