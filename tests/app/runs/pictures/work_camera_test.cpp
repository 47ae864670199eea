#include "runs/pictures/work_camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../../../graft_bench_case.h"

namespace osteon {
namespace {

constexpr double kPi = 3.14159265358979;

// Of a practice box, turned about z: two portals behind, three posts in front of them.
std::array<Vec3, 5> box_points(double turn_rad) {
  const Quat q(Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()));
  return {q * Vec3(-0.05, -0.03, 0.056), q * Vec3(-0.05, 0.03, 0.056), q * Vec3(0.02, -0.016, 0.01),
          q * Vec3(0.02, 0, 0.01), q * Vec3(0.02, 0.016, 0.01)};
}

TEST(WorkCamera, AllThatMattersIsInThePictureHandsToTheLeftOfTheWork) {
  for (const double turn_rad : {0.0, 1.0, kPi, -2.0})
    for (const double aspect : {0.6, 1.0, 1.8}) {
      const auto points = box_points(turn_rad);
      const Camera camera = side_camera({}, {points.data(), 2}, {points.data() + 2, 3}, aspect);
      const Pose X_CW = camera.X_WC().inverse();
      const double half_tan = std::tan(0.5 * camera.vertical_fov_rad);
      for (const Vec3& p_W : points) {
        const Vec3 p_C = X_CW * p_W;
        ASSERT_LT(p_C.z(), 0);
        EXPECT_LT(std::abs(p_C.y() / -p_C.z()), half_tan) << turn_rad << " " << aspect;
        EXPECT_LT(std::abs(p_C.x() / -p_C.z()), aspect * half_tan) << turn_rad << " " << aspect;
      }
      EXPECT_LT((X_CW * points[0]).x(), (X_CW * points[3]).x() - 0.03);
      EXPECT_LT((X_CW * points[1]).x(), (X_CW * points[3]).x() - 0.03);
      EXPECT_GT(camera.eye_W().z(), 0.05) << "from above";
      EXPECT_GT((camera.q_WC * Vec3::UnitY()).z(), 0.5) << "upright";
    }
}

TEST(WorkCamera, SkinIsSeenFromNearItsAxisUpwards) {
  const Pose X_WS{Vec3(0.04, -0.03, 0.02),
                  Quat(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()))};
  const Camera camera = skin_camera({}, X_WS);
  const Pose X_CW = camera.X_WC().inverse();
  const double half_tan = std::tan(0.5 * camera.vertical_fov_rad);
  for (const Vec3& p_S : {Vec3(0.02, 0.028, 0), Vec3(-0.02, 0.028, 0), Vec3(-0.02, -0.028, 0)}) {
    const Vec3 p_C = X_CW * (X_WS * p_S);
    ASSERT_LT(p_C.z(), 0);
    EXPECT_LT(std::max(std::abs(p_C.x()), std::abs(p_C.y())), 0.7 * half_tan * -p_C.z());
  }
  const Vec3 up_C = X_CW.rotate(X_WS.rotate(Vec3::UnitY()));
  EXPECT_NEAR(up_C.x(), 0, 1e-9);
  EXPECT_GT(up_C.y(), 0.8);
  EXPECT_GT((X_WS.inverse() * camera.eye_W()).z(), 0.1);
}

TEST(WorkCamera, ABenchIsSeenFromAboveAndFromWhereTheOperatorIs) {
  const auto bench = find_graft_bench(*testing::bench_case());
  ASSERT_TRUE(bench);
  for (const double aspect : {0.6, 1.0, 1.8}) {
    const Camera camera = bench_camera({}, *bench, aspect);
    const Pose X_CW = camera.X_WC().inverse();
    const double half_tan = std::tan(0.5 * camera.vertical_fov_rad);
    for (const Vec3& p_W :
         {bench->hook_W, bench->board_to_W, bench->posts_W[2], bench->tendons[0].bands_W[1],
          bench->tendons[0].insertion_W, beside_bench(*bench).p}) {
      const Vec3 p_C = X_CW * p_W;
      ASSERT_LT(p_C.z(), 0);
      EXPECT_LT(std::abs(p_C.y() / -p_C.z()), half_tan) << aspect;
      EXPECT_LT(std::abs(p_C.x() / -p_C.z()), aspect * half_tan) << aspect;
    }
    EXPECT_GT(camera.eye_W().z(), 0.1);
    // Farther along the tendon is higher in the picture.
    EXPECT_GT((X_CW * bench->tendons[0].bands_W[1]).y(),
              (X_CW * bench->tendons[0].insertion_W).y());
  }
  Camera camera;
  EXPECT_EQ(bench_camera(camera, *bench, 1.8, true), bench_camera(camera, *bench, 1.8));
  const auto covered = find_graft_bench(*testing::bench_case(testing::covered_bench_def()));
  const Camera near = bench_camera(camera, *covered, 1.8, true);
  EXPECT_LT(near.distance_m, 0.5 * bench_camera(camera, *covered, 1.8).distance_m);
  EXPECT_LT((near.target_W - covered->fascia_from_W).norm(), 0.03);
  const Vec3 along_C = near.X_WC().inverse().rotate(covered->fascia_along_W());
  EXPECT_NEAR(along_C.y(), 1, 1e-9) << "a stroke along the mark goes up the picture";
  // A hand that comes there is in that picture.
  const Vec3 hand_C = near.X_WC().inverse() * beside_bench(*covered, true).p;
  const double half_tan = std::tan(0.5 * near.vertical_fov_rad);
  EXPECT_LT(std::abs(hand_C.y()), -0.6 * half_tan * hand_C.z());
  EXPECT_LT(std::abs(hand_C.x()), -0.6 * half_tan * hand_C.z());
  EXPECT_EQ(beside_bench(*bench, true).p, beside_bench(*bench).p);
  EXPECT_EQ(bench_camera(camera, *bench, 0), camera);
}

TEST(WorkCamera, WhoWorksAtTheBenchIsNearWhatLiesThere) {
  const auto bench = find_graft_bench(*testing::bench_case());
  ASSERT_TRUE(bench);
  for (const Vec3& p_W :
       {bench->hook_W, bench->board_to_W, bench->tendons[1].insertion_W, beside_bench(*bench).p})
    EXPECT_TRUE(is_at_bench(*bench, p_W));
  EXPECT_TRUE(is_at_bench(*bench, bench->end_W(GraftBenchPlan::kSemitendinosus)));
  const Vec3 beyond_W = bench->tendons[0].insertion_W - 0.3 * bench->tendons[0].along_W;
  EXPECT_FALSE(is_at_bench(*bench, beyond_W));
  EXPECT_FALSE(is_at_bench(*bench, bench->hook_W + 0.3 * Vec3::UnitZ()));
}

TEST(WorkCamera, WithoutPortalsOrWorkItStays) {
  const auto points = box_points(0);
  Camera camera;
  camera.distance_m = 0.123;
  EXPECT_EQ(side_camera(camera, {}, points, 1), camera);
  EXPECT_EQ(side_camera(camera, points, {}, 1), camera);
  EXPECT_EQ(side_camera(camera, points, points, 0), camera);
  // Straight above the work there is no near side: any will do.
  const Vec3 above(0, 0, 0.1), work(0, 0, 0);
  EXPECT_TRUE(is_finite(side_camera(camera, {&above, 1}, {&work, 1}, 1).q_WC * Vec3::UnitX()));
}

}  // namespace
}  // namespace osteon
