#include "osteon/xray/c_arm.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "phantoms.h"

namespace osteon {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

TEST(CArm, RefusesWhatNoArmCanDo) {
  const auto refused = [](auto&& change) {
    CArm arm;
    change(arm);
    return !xray_view(arm, {});
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused([&](CArm& a) { a.orbit_rad = nan; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.lift_m = 1e9; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.source_detector_m = 0; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.source_isocenter_m = 1.0; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.isocenter_W.x() = nan; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.detector_m = -1; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.width_px = 0; }));
  EXPECT_TRUE(refused([&](CArm& a) { a.height_px = 5000; }));
}

TEST(CArm, ApAndLateralLookAsNamed) {
  const PatientAxes patient;  // up y, front z, outside -x
  CArm arm;
  arm.isocenter_W = Vec3(0.1, 0.2, 0.3);
  const auto ap = xray_view(arm, patient);
  ASSERT_TRUE(ap);
  EXPECT_TRUE(ap->source_W.isApprox(Vec3(0.1, 0.2, 0.9), 1e-12));
  EXPECT_TRUE(ap->detector_center_W.isApprox(Vec3(0.1, 0.2, -0.1), 1e-12));
  EXPECT_TRUE(ap->u_W.isApprox(Vec3::UnitX(), 1e-12));
  EXPECT_TRUE(ap->v_W.isApprox(-Vec3::UnitY(), 1e-12));
  arm.orbit_rad = kQuarter;
  const auto lateral = xray_view(arm, patient);
  ASSERT_TRUE(lateral);
  EXPECT_TRUE(lateral->source_W.isApprox(Vec3(-0.5, 0.2, 0.3), 1e-12));
  EXPECT_TRUE(lateral->v_W.isApprox(-Vec3::UnitY(), 1e-12));
}

TEST(CArm, AngulationTipsTheSourceUpwardsAndLiftCarriesAll) {
  CArm arm;
  arm.angulation_rad = std::numbers::pi / 6;
  arm.lift_m = 0.05;
  const auto view = xray_view(arm, {});
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->source_W.isApprox(Vec3(0, 0.3, 0.05 + 0.6 * std::sqrt(0.75)), 1e-12));
  EXPECT_NEAR(view->source_detector_m(), 1, 1e-12);
  EXPECT_NEAR(view->u_W.dot(view->v_W), 0, 1e-12);
}

TEST(CArm, TheIsocentreIsTheMiddleOfEveryPicture) {
  for (const double orbit : {-2.0, 0.0, 0.7, 3.0})
    for (const double angulation : {-0.6, 0.0, 0.4}) {
      CArm arm;
      arm.orbit_rad = orbit;
      arm.angulation_rad = angulation;
      arm.isocenter_W = Vec3(0.01, -0.02, 0.03);
      const auto view = xray_view(arm, {});
      ASSERT_TRUE(view);
      const auto pixel = project(*view, arm.isocenter_W);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->column, 255.5, 1e-6);
      EXPECT_NEAR(pixel->row, 255.5, 1e-6);
    }
}

/// By hand: a point 20 mm aside and 100 mm nearer to the source than the isocentre is magnified
/// 1000 / 500 times.
TEST(CArm, ProjectionIsThatOfAPinhole) {
  const XrayView view = testing_xray::view_from_above(128, 0.0008);
  const auto pixel = project(view, Vec3(0.02, 0.01, 0.1));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->column, 63.5 + 0.04 / 0.0008, 1e-9);
  EXPECT_NEAR(pixel->row, 63.5 - 0.02 / 0.0008, 1e-9);
  EXPECT_FALSE(project(view, Vec3(0, 0, 0.7)));
  EXPECT_FALSE(project(view, Vec3(0, 0, std::numeric_limits<double>::quiet_NaN())));
}

/// The centre of a small ball's shadow is where the ball's centre falls.
TEST(CArm, LandmarksLieWhereTheirShadowsAre) {
  CArm arm;
  arm.orbit_rad = 0.5;
  arm.angulation_rad = -0.3;
  const auto view = xray_view(arm, {});
  ASSERT_TRUE(view);
  for (const Vec3& at : {Vec3(0.02, 0.03, -0.01), Vec3(-0.04, 0.01, 0.03), Vec3(0, -0.05, 0.02)}) {
    const auto got =
        areal_density({{testing_xray::layer(testing_xray::ball(at, 0.002, 24), 1)}}, *view);
    ASSERT_TRUE(got);
    const std::vector<float> total = got->total();
    double mass = 0, column = 0, row = 0;
    for (int n = 0; n < 512 * 512; ++n) {
      const double m = static_cast<double>(total[static_cast<std::size_t>(n)]);
      mass += m;
      column += m * (n % 512);
      row += m * (n / 512);
    }
    const auto pixel = project(*view, at);
    ASSERT_TRUE(pixel && mass > 0);
    EXPECT_NEAR(column / mass, pixel->column, 0.1);
    EXPECT_NEAR(row / mass, pixel->row, 0.1);
  }
}

}  // namespace
}  // namespace osteon
