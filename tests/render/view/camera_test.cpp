#include "osteon/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kPi = std::numbers::pi;

Camera any_camera(Random& random) {
  Camera camera;
  camera.target_W = random.direction();
  camera.distance_m = random.uniform(0.1, 1.0);
  camera.q_WC = random.rotation();
  camera.vertical_fov_rad = random.uniform(0.2, 1.2);
  return camera;
}

double elevation_deg(const Camera& camera, const Vec3& axis_W) {
  return std::asin((camera.q_WC * Vec3::UnitZ()).dot(axis_W)) * 180 / kPi;
}

TEST(Camera, DefaultLooksAlongMinusZ) {
  const Camera camera;
  EXPECT_TRUE(camera.eye_W().isApprox(Vec3(0, 0, camera.distance_m)));
}

TEST(Camera, LookRotationHasItsAxesWhereAsked) {
  const Quat q = look_rotation(Vec3(0, 3, 0), Vec3(0.5, 1, 7));
  EXPECT_TRUE((q * Vec3::UnitZ()).isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_GT((q * Vec3::UnitY()).z(), 0.9);
  EXPECT_NEAR((q * Vec3::UnitX()).dot(Vec3(0.5, 1, 7)), 0, 1e-12);
}

TEST(Camera, ProjectAndRayAreInverse) {
  Random random(1);
  const Viewport viewport{0, 0, 640, 480};
  for (int k = 0; k < 500; ++k) {
    Camera camera = any_camera(random);
    camera.orthographic = k % 2 == 1;
    const double x = random.uniform(0, 640);
    const double y = random.uniform(0, 480);
    const Ray ray = ray_through(camera, viewport, x, y);
    const double length = random.uniform(20.1, 25.0);
    const auto p = project(camera, viewport, ray.origin_W + ray.dir_W * length);
    ASSERT_TRUE(p.has_value());
    EXPECT_NEAR(p->x, x, 1e-6);
    EXPECT_NEAR(p->y, y, 1e-6);
    EXPECT_NEAR(ray.dir_W.norm(), 1, 1e-12);
  }
}

TEST(Camera, TargetIsInTheMiddleAndAtItsDistance) {
  Random random(2);
  const Camera camera = any_camera(random);
  const auto p = project(camera, {0, 0, 200, 100}, camera.target_W);
  ASSERT_TRUE(p.has_value());
  EXPECT_NEAR(p->x, 100, 1e-9);
  EXPECT_NEAR(p->y, 50, 1e-9);
  EXPECT_NEAR(p->depth_m, camera.distance_m, 1e-12);
}

TEST(Camera, NothingProjectsFromBehindTheEyeOrFromNowhere) {
  const Camera camera;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(project(camera, {}, Vec3(0, 0, 1)).has_value());
  EXPECT_FALSE(project(camera, {}, Vec3(0, nan, 0)).has_value());
  Camera parallel;
  parallel.orthographic = true;
  EXPECT_TRUE(project(parallel, {}, Vec3(0, 0, 1)).has_value());
}

TEST(Camera, OrbitKeepsTargetDistanceAndUprightness) {
  Random random(3);
  const Vec3 axis_W = random.direction();
  Camera camera;
  camera.target_W = Vec3(0.1, 0.2, 0.3);
  camera.q_WC = look_rotation(axis_W.unitOrthogonal(), axis_W);
  for (int k = 0; k < 400; ++k) {
    const double yaw = random.uniform(-1, 1);
    const double pitch = random.uniform(-1, 1);
    camera = orbit(camera, axis_W, yaw, pitch);
    EXPECT_NEAR((camera.eye_W() - camera.target_W).norm(), camera.distance_m, 1e-12);
    EXPECT_LE(std::abs(elevation_deg(camera, axis_W)), 89.001);
    // The axis stays upright on the screen: no roll creeps in.
    EXPECT_NEAR((camera.q_WC * Vec3::UnitX()).dot(axis_W), 0, 1e-9);
    EXPECT_GT((camera.q_WC * Vec3::UnitY()).dot(axis_W), 0);
  }
}

TEST(Camera, OrbitFollowsTheDrag) {
  Camera camera;  // y is the axis; the point in front of the target is what the hand holds
  camera.distance_m = 1;
  const Viewport viewport{0, 0, 100, 100};
  const Vec3 held_W(0, 0, 0.1);
  const auto right = project(orbit(camera, Vec3::UnitY(), 0.2, 0), viewport, held_W);
  EXPECT_GT(right->x, 51);
  EXPECT_NEAR(right->y, 50, 1e-9);
  const auto up = project(orbit(camera, Vec3::UnitY(), 0, 0.2), viewport, held_W);
  EXPECT_LT(up->y, 49);
  EXPECT_NEAR(up->x, 50, 1e-9);
}

TEST(Camera, OrbitTurnsByTheAngleGiven) {
  const Camera turned = orbit(Camera{}, Vec3::UnitY(), 0.3, 0);
  EXPECT_NEAR(turned.q_WC.angularDistance(Quat::Identity()), 0.3, 1e-12);
  EXPECT_NEAR(elevation_deg(orbit(Camera{}, Vec3::UnitY(), 0, -0.5), Vec3::UnitY()),
              0.5 * 180 / kPi, 1e-9);
}

TEST(Camera, PanMovesTheTargetsPlaneWithThePointer) {
  Random random(4);
  const Viewport viewport{0, 0, 300, 200};
  for (int k = 0; k < 50; ++k) {
    const Camera camera = any_camera(random);
    const auto p = project(pan(camera, 0.25, -0.1), viewport, camera.target_W);
    ASSERT_TRUE(p.has_value());
    EXPECT_NEAR(p->x, 150 + 0.25 * 200, 1e-6);
    EXPECT_NEAR(p->y, 100 + 0.1 * 200, 1e-6);
  }
}

TEST(Camera, ZoomStaysWithinItsLimits) {
  EXPECT_DOUBLE_EQ(zoom(Camera{}, 2).distance_m, 0.5);
  EXPECT_DOUBLE_EQ(zoom(Camera{}, 1e-9).distance_m, 0.005);
  EXPECT_DOUBLE_EQ(zoom(Camera{}, 1e9).distance_m, 20);
}

TEST(Camera, MetresPerPixelAgreesWithProjection) {
  Random random(5);
  const Viewport viewport{0, 0, 800, 600};
  for (int k = 0; k < 50; ++k) {
    Camera camera = any_camera(random);
    camera.orthographic = k % 2 == 1;
    const Vec3 p_W = camera.target_W + camera.q_WC * Vec3(0, 0, 0.3 * camera.distance_m);
    const Vec3 q_W = p_W + camera.q_WC * Vec3(1e-3, 0, 0);
    const double pixels = project(camera, viewport, q_W)->x - project(camera, viewport, p_W)->x;
    EXPECT_NEAR(metres_per_pixel(camera, viewport, p_W) * pixels, 1e-3, 1e-9);
  }
}

}  // namespace
}  // namespace osteon
