#include "osteon/scene/limb_cover.h"

#include <gtest/gtest.h>

#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

// Two bones that leave the joint at the origin at a right angle: the femur along x, the tibia along
// -z. Both have moved frames, so that a mistake between Bone and World shows.
Case bent_limb() {
  Case limb;
  const auto add = [&](const char* name, const Vec3& from_W, const Vec3& to_W) {
    Bone bone;
    bone.name = name;
    bone.X_WB = {Vec3(0.3, -0.1, 0.2), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
    for (int k = 0; k <= 20; ++k)
      bone.mesh.vertices.push_back(bone.X_WB.inverse() * Vec3(from_W + k / 20.0 * (to_W - from_W)));
    bone.mesh.triangles = {{0, 1, 2}};
    limb.bones.push_back(bone);
  };
  add("femur", Vec3(0.010, 0, 0.002), Vec3(0.310, 0, 0.002));
  add("tibia", Vec3(0.002, 0, -0.010), Vec3(0.002, 0, -0.310));
  limb.landmarks.push_back({"portal_al", Vec3(-0.040, 0.015, 0.030), Vec3::UnitX(), "tibia"});
  limb.landmarks.push_back({"portal_up", Vec3(-0.010, 0.015, 0.230), Vec3::UnitX(), "femur"});
  limb.landmarks.push_back({"acl_tibia", Vec3(0.200, 0, 0), Vec3::Zero(), "tibia"});
  return limb;
}

TEST(LimbCover, KnowsTheKneecapWhereThereIsOne) {
  Case limb = bent_limb();
  ASSERT_TRUE(LimbCover::over(limb));
  EXPECT_FALSE(LimbCover::over(limb)->kneecap().valid());
  limb.bones.emplace_back().name = "patella";
  EXPECT_EQ(LimbCover::over(limb)->kneecap().index, 2u);
}

std::vector<Pose> rest_of(const Case& limb) {
  std::vector<Pose> out;
  for (const Bone& bone : limb.bones) out.push_back(bone.X_WB);
  return out;
}

BoneSnapshot moved_by(const Case& limb, const Pose& upper, const Pose& lower) {
  BoneSnapshot bones;
  bones.count = 2;
  bones.bones[0].X_WB = upper * limb.bones[0].X_WB;
  bones.bones[1].X_WB = lower * limb.bones[1].X_WB;
  return bones;
}

Pose random_motion(Random& random, double turn_rad, double way_m) {
  const auto one = [&] { return random.uniform(-1, 1); };
  const Vec3 axis = Vec3(one(), one(), one()).normalized();
  const Vec3 way = Vec3(one(), one(), one());
  return {way_m * way, Quat(Eigen::AngleAxisd(turn_rad, axis))};
}

TEST(LimbCover, WithoutBothBonesOrDirectionsThereIsNone) {
  Case limb = bent_limb();
  limb.bones[1].name = "ulna";
  EXPECT_FALSE(LimbCover::over(limb));
  limb = bent_limb();
  limb.bones.pop_back();
  EXPECT_FALSE(LimbCover::over(limb));
  limb = bent_limb();
  limb.bones[0].mesh.vertices.clear();
  EXPECT_FALSE(LimbCover::over(limb));
  limb = bent_limb();
  limb.bones[1].mesh = limb.bones[0].mesh;  // the same place
  EXPECT_FALSE(LimbCover::over(limb));
}

TEST(LimbCover, OneEndGoesWithEachBoneAndBetweenThemItIsShared) {
  const Case limb = bent_limb();
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  // Half way between both directions: along (-1, 0, -1).
  EXPECT_LT((cover->towards_lower_W() - Vec3(-1, 0, -1).normalized()).norm(), 0.05);
  EXPECT_EQ(cover->share(Vec3(0.250, 0.040, 0)), 0);
  EXPECT_EQ(cover->share(Vec3(0, 0.040, -0.250)), 1);
  double last = 0;
  for (int k = -120; k <= 120; ++k) {  // across the hollow of the knee, far from the portals
    const double share =
        cover->share(Vec3(0.150, -0.030, -0.150) + 0.001 * k * cover->towards_lower_W());
    EXPECT_GE(share, last) << k;
    last = share;
  }
  EXPECT_EQ(last, 1);
  EXPECT_NEAR(cover->share(cover->middle_W() - Vec3(0, 0.300, 0)), 0.5, 1e-12);
}

TEST(LimbCover, AboutAPortalItGoesWithThatPortalsBone) {
  const Case limb = bent_limb();
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  ASSERT_EQ(cover->wholes().size(), 2u);
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 aside =
        LimbCover::kWholeTo_m *
        Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    EXPECT_NEAR(cover->share(limb.landmarks[1].p_W + aside), 0, 1e-12);
    EXPECT_NEAR(cover->share(limb.landmarks[0].p_W + aside), 1, 1e-12);
  }
}

TEST(LimbCover, AtRestNothingMoves) {
  const Case limb = bent_limb();
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  const CoverMotion motion = cover->motion(moved_by(limb, {}, {}), rest_of(limb));
  for (const double share : {0.0, 0.3, 1.0})
    EXPECT_LT((motion.moved(Vec3(0.1, 0.2, 0.3), share) - Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);
  BoneSnapshot one = moved_by(limb, {}, {});
  one.count = 1;  // the tibia is not told of
  EXPECT_EQ(cover->motion(one, rest_of(limb)).angle_rad, 0);
}

// The bones' own motions are the oracle at both ends; between them, half the way twice is the
// whole.
TEST(LimbCover, TheEndsMoveAsTheBonesDoWhateverTheMotion) {
  const Case limb = bent_limb();
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  Random random(7);
  const double turns[] = {0, 1e-7, 1e-5, 2e-4, 0.01, 0.7, 2.2, 3.1, std::numbers::pi};
  for (const double turn : turns)
    for (int n = 0; n < 50; ++n) {
      const Pose upper = random_motion(random, random.uniform(-3, 3), 0.2);
      const Pose lower = upper * random_motion(random, turn, 0.02);
      const CoverMotion motion = cover->motion(moved_by(limb, upper, lower), rest_of(limb));
      const Vec3 p(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
      const double allowed_m = turn < 1e-4 ? 1e-5 : 1e-9;
      EXPECT_LT((motion.moved(p, 0) - upper * p).norm(), 1e-12);
      EXPECT_LT((motion.moved(p, 1) - lower * p).norm(), allowed_m) << turn;
      CoverMotion only = motion;
      only.upper = {};
      const Vec3 twice = only.moved(only.moved(p, 0.5), 0.5);
      EXPECT_LT((twice - only.moved(p, 1)).norm(), 1e-9) << turn;
    }
}

// A limb that bends by 40 degrees: skin on a ring about it neither folds nor tears.
TEST(LimbCover, SkinStaysWhole) {
  const Case limb = bent_limb();
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  const Pose lower{Vec3::Zero(), Quat(Eigen::AngleAxisd(0.7, Vec3::UnitY()))};
  const CoverMotion motion = cover->motion(moved_by(limb, {}, lower), rest_of(limb));
  EXPECT_NEAR(motion.angle_rad, 0.7, 1e-12);
  for (const double y : {-0.045, 0.0, 0.045}) {
    // In front, from the thigh (z = 0.045) round to the shank (x = -0.045).
    Vec3 was = Vec3::Zero();
    for (int k = 0; k <= 300; ++k) {
      const double s = 0.001 * (k - 150);
      const Vec3 p = s < 0 ? Vec3(-0.045 - s, y, 0.045) : Vec3(-0.045, y, 0.045 - s);
      const Vec3 now = motion.moved(p, cover->share(p));
      if (k > 0) {
        EXPECT_GT((now - was).norm(), 0.15e-3) << y << " " << k;
        EXPECT_LT((now - was).norm(), 2.5e-3) << y << " " << k;
      }
      was = now;
    }
  }
}

}  // namespace
}  // namespace osteon
