// What must hold of the whole tick, on bones of pieces and on bones felt as fields. Closed forms of
// blocks are the judges.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "contact_field.h"
#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "test_scene.h"

namespace osteon {
namespace {

// A block with its top at z = 0, cut at random into eight boxes.
Bone cut_block(Random& random) {
  const double cut_x = random.uniform(-0.002, 0.002);
  const double cut_y = random.uniform(-0.002, 0.002);
  const double cut_z = random.uniform(-0.004, -0.001);
  const Vec3 inner(cut_x, cut_y, cut_z);
  std::vector<Hull> pieces;
  for (const double x : {-0.02, 0.02})
    for (const double y : {-0.02, 0.02})
      for (const double z : {-0.01, 0.0}) {
        const Vec3 corner(x, y, z);
        pieces.push_back(test::box_hull(0.5 * (corner - inner).cwiseAbs(), 0.5 * (corner + inner)));
      }
  return test::bone_of(std::move(pieces));
}

// Deeper and deeper, through the pieces of the top and those below: what is felt is the block.
TEST(HapticProperty, PushingIntoACutBlockIsPushingIntoABlock) {
  Random random(101);
  for (int i = 0; i < 40; ++i) {
    test::Rig rig({cut_block(random)});
    const double x = i % 4 == 0 ? 0 : random.uniform(-0.003, 0.003);
    const double y = random.uniform(-0.003, 0.003);
    const Quat turn = random.rotation();
    const double rest = support(rig.tool->bodies[0], turn.conjugate() * -Vec3::UnitZ()) + kSkin;
    double last = -1;
    for (int k = 0; k < 140; ++k) {
      const double z = 0.002 - 5e-5 * k;
      const ToolState& s = rig.at(Vec3(x, y, z), turn);
      EXPECT_NEAR(s.X_WP.p.z(), std::max(z, rest), 2e-9) << k;
      EXPECT_NEAR(s.X_WP.p.x(), x, 2e-9);
      EXPECT_GE(s.force_W.norm(), last);
      last = s.force_W.norm();
    }
    EXPECT_GT(last, 10);
  }
}

// A stroke over the cuts, which stays on the one plane.
TEST(HapticProperty, StrokingACutBlockIsStrokingABlock) {
  Random random(102);
  double highest = 0, lowest = 0;
  for (int i = 0; i < 20; ++i) {
    test::Rig rig({cut_block(random)});
    const Vec3 way = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0).normalized();
    const double rest = test::tip_reach(rig) + kSkin;
    const Vec3 start = -0.005 * way;
    rig.at(start + Vec3(0, 0, 0.002));
    test::go(rig, start + Vec3(0, 0, 0.002), start - Vec3(0, 0, 0.001), 100);
    for (int k = 0; k < 500; ++k) {
      const ToolState& s = rig.at(start + 2e-5 * k * way - Vec3(0, 0, 0.001));
      highest = std::max(highest, s.X_WP.p.z() - rest);
      lowest = std::min(lowest, s.X_WP.p.z() - rest);
      EXPECT_GT(s.contact_count, 0u);
    }
  }
  RecordProperty("highest_nm", std::to_string(1e9 * highest));
  EXPECT_LT(highest, 1e-7);
  EXPECT_GT(lowest, -2e-9);
}

Bone moved_bone(Bone bone, const Pose& X) {
  bone.X_WB = X * bone.X_WB;
  return bone;
}

// The same strokes with bones and hand elsewhere in the world.
void expect_the_same_elsewhere(const Bone& bone, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 5; ++i) {
    const Vec3 shift = random.direction();
    const Pose X{shift, random.rotation()};
    test::Rig here({bone});
    test::Rig there({moved_bone(bone, X)});
    const Vec3 from = 0.008 * random.direction();
    const Vec3 to = 0.003 * random.direction();
    for (int k = 0; k <= 200; ++k) {
      const Vec3 p = from + (k / 200.0) * (to - from);
      const ToolState& a = here.at(p);
      const ToolState& b = there.at(X * p, X.q);
      ASSERT_LT((X * a.X_WP.p - b.X_WP.p).norm(), 1e-9) << i << " " << k;
      ASSERT_LT((X.rotate(a.force_W) - b.force_W).norm(), 1e-9 * 1e4) << i << " " << k;
    }
    EXPECT_GT(here.at(to).contact_count, 0u);
  }
}

TEST(HapticProperty, MovingPiecesAndHandTogetherChangesNothing) {
  Random random(103);
  std::vector<Hull> pieces;
  for (int k = 0; k < 6; ++k) {
    std::vector<Vec3> points;
    const Vec3 middle = 0.003 * random.direction();
    for (int n = 0; n < 30; ++n) points.push_back(middle + 0.0035 * random.direction());
    pieces.push_back(test::hull_of(points));
  }
  expect_the_same_elsewhere(test::bone_of(std::move(pieces)), 104);
}

TEST(HapticProperty, MovingAFieldAndHandTogetherChangesNothing) {
  expect_the_same_elsewhere(test::field_bone(test::sphere(0.005, 24)), 105);
}

}  // namespace
}  // namespace osteon
