#include "osteon/base/pose_track.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

Pose turned(double radians, const Vec3& p) {
  return {p, Quat(Eigen::AngleAxisd(radians, Vec3(1, 2, 2) / 3))};
}

/// Along a circle, turning with it: known in closed form.
Pose on_circle(double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180;
  return turned(a, {0.1 * std::cos(a), 0.1 * std::sin(a), 0.02 * a});
}

PoseTrack circle() {
  PoseTrack track{10, 5, {}};
  for (double d = 10; d <= 130; d += 5) track.poses.push_back(on_circle(d));
  return track;
}

double apart(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() + 0.1 * a.q.angularDistance(b.q);
}

TEST(PoseTrack, OfOnePoseStays) {
  const PoseTrack track{3, 1, {turned(1, {1, 2, 3})}};
  for (const double x : {-5.0, 3.0, 9.0})
    EXPECT_EQ(apart(pose_at(track, x), track.poses[0]), 0) << x;
}

TEST(PoseTrack, IsKeptWithinItsEnds) {
  EXPECT_EQ(circle().last(), 130);
  EXPECT_EQ(apart(pose_at(circle(), -40), circle().poses.front()), 0);
  EXPECT_EQ(apart(pose_at(circle(), 400), circle().poses.back()), 0);
}

TEST(PoseTrack, GoesThroughEveryPoseAndNearTheCircleBetween) {
  for (double d = 10; d <= 130; d += 5)
    EXPECT_EQ(apart(pose_at(circle(), d), on_circle(d)), 0) << d;
  for (double d = 16; d <= 124; d += 1.3)
    EXPECT_LT(apart(pose_at(circle(), d), on_circle(d)), 2e-5) << d;
}

TEST(PoseTrack, RatesDoNotJumpAtThePoses) {
  const PoseTrack track = circle();
  const double h = 1e-4;
  for (double d = 15; d <= 125; d += 5) {
    const Pose before = pose_at(track, d - h), at = pose_at(track, d),
               after = pose_at(track, d + h);
    EXPECT_LT((after.p - 2 * at.p + before.p).norm() / h, 1e-5) << d;
    const Quat on = after.q * at.q.conjugate(), off = at.q * before.q.conjugate();
    EXPECT_LT(on.angularDistance(off) / h, 1e-4) << d;
  }
}

TEST(PoseTrack, TheSignOfAQuaternionDoesNotMatter) {
  PoseTrack flipped = circle();
  for (std::size_t i = 0; i < flipped.poses.size(); i += 3)
    flipped.poses[i].q.coeffs() = -flipped.poses[i].q.coeffs();
  for (double d = 11; d < 130; d += 2.7)
    EXPECT_LT(apart(pose_at(flipped, d), pose_at(circle(), d)), 1e-9) << d;
}

}  // namespace
}  // namespace osteon
