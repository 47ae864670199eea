#include "runs/hands/probe_drag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osteon/base/random.h"
#include "ui/camera_control.h"

namespace osteon {
namespace {

Camera some_camera(Random& random) {
  Camera camera;
  camera.q_WC = random.rotation();
  camera.target_W = 0.1 * random.direction();
  camera.distance_m = 0.3;
  return camera;
}

TEST(ProbeDrag, TheTipStaysUnderThePointer) {
  Random random(5);
  const Viewport viewport{0, 0, 1000, 700};
  for (int i = 0; i < 200; ++i) {
    const Camera camera = some_camera(random);
    Pose X_WD{camera.target_W + 0.03 * random.direction(), random.rotation()};
    const auto before = project(camera, viewport, X_WD.p);
    ASSERT_TRUE(before);
    ProbeMotion motion;
    motion.right_px = random.uniform(-80, 80);
    motion.up_px = random.uniform(-80, 80);
    X_WD = drag_probe(X_WD, motion, camera, viewport, 0.016);
    const auto after = project(camera, viewport, X_WD.p);
    ASSERT_TRUE(after);
    EXPECT_NEAR(after->x - before->x, motion.right_px, 0.01);
    EXPECT_NEAR(before->y - after->y, motion.up_px, 0.01);
    EXPECT_NEAR(after->depth_m, before->depth_m, 1e-9);
  }
}

TEST(ProbeDrag, TheWheelMovesAlongTheViewOnly) {
  Random random(6);
  const Viewport viewport{0, 0, 1000, 700};
  const Camera camera = some_camera(random);
  const Pose X_WD{camera.target_W, Quat::Identity()};
  ProbeMotion motion;
  motion.wheel = 2;
  const Pose moved = drag_probe(X_WD, motion, camera, viewport, 0.016);
  const Vec3 step_C = camera.q_WC.conjugate() * (moved.p - X_WD.p);
  EXPECT_NEAR((step_C - Vec3(0, 0, -0.004)).norm(), 0, 1e-12);
}

TEST(ProbeDrag, AnInstrumentGoesAlongItsShaftHoweverItIsSeen) {
  Random random(8);
  const Viewport viewport{0, 0, 1000, 700};
  for (int i = 0; i < 50; ++i) {
    const Camera camera = some_camera(random);
    const Pose X_WD{camera.target_W, random.rotation()};
    ProbeMotion motion;
    motion.along = 3;
    const Pose moved = drag_probe(X_WD, motion, camera, viewport, 0.016);
    EXPECT_NEAR((moved.p - X_WD.p + 0.006 * (X_WD.q * Vec3::UnitZ())).norm(), 0, 1e-12);
    EXPECT_NEAR(moved.q.angularDistance(X_WD.q), 0, 1e-7);
  }
}

TEST(ProbeDrag, UprightTheTipPointsAtTheSurfaceAndStaysWhereItIs) {
  Random random(9);
  for (int i = 0; i < 50; ++i) {
    const Pose X_WD{0.1 * random.direction(), random.rotation()};
    const Vec3 out_W = random.direction();
    for (const bool inside : {false, true}) {
      const Vec3 p_W = X_WD.p - (inside ? -0.004 : 0.004) * out_W;
      const Pose upright = upright_on(X_WD, p_W, inside);
      EXPECT_EQ(upright.p, X_WD.p);
      EXPECT_NEAR((upright.q * Vec3::UnitZ() - out_W).norm(), 0, 1e-9);
      // No more turned than the shaft's directions are apart.
      const double apart = std::acos(std::clamp(out_W.dot(X_WD.q * Vec3::UnitZ()), -1.0, 1.0));
      EXPECT_NEAR(upright.q.angularDistance(X_WD.q), apart, 1e-6);
    }
  }
  const Pose on_it{Vec3(1, 2, 3), Quat::Identity()};
  EXPECT_EQ(upright_on(on_it, on_it.p, false).q.coeffs(), on_it.q.coeffs());
}

TEST(ProbeDrag, TurnsKeepTheTipAndAUnitQuaternion) {
  Random random(7);
  const Camera camera = some_camera(random);
  Pose X_WD{camera.target_W, random.rotation()};
  const Vec3 tip_W = X_WD.p;
  ProbeMotion motion;
  motion.yaw = 1;
  motion.roll = -1;
  for (int i = 0; i < 5000; ++i) X_WD = drag_probe(X_WD, motion, camera, {}, 0.016);
  EXPECT_EQ(X_WD.p, tip_W);
  EXPECT_NEAR(X_WD.q.norm(), 1, 1e-12);
}

// However the camera looks: the shaft and the tip stay, and a hook goes round them.
TEST(ProbeDrag, ATwistTurnsAHookAboutItsShaft) {
  Random random(9);
  const Camera camera = some_camera(random);
  Pose X_WD{camera.target_W, random.rotation()};
  const Pose before = X_WD;
  ProbeMotion motion;
  motion.twist = 1;
  for (int i = 0; i < 100; ++i) X_WD = drag_probe(X_WD, motion, camera, {}, 0.01);
  EXPECT_EQ(X_WD.p, before.p);
  EXPECT_NEAR((X_WD.q * Vec3::UnitZ() - before.q * Vec3::UnitZ()).norm(), 0, 1e-12);
  const Vec3 hook = before.q.conjugate() * (X_WD.q * Vec3::UnitX());
  EXPECT_NEAR((hook - Vec3(std::cos(1.2), std::sin(1.2), 0)).norm(), 0, 1e-9);
}

TEST(ProbeDrag, TheProbeCannotBeLost) {
  Random random(8);
  const Camera camera = some_camera(random);
  Pose X_WD{camera.target_W, Quat::Identity()};
  ProbeMotion motion;
  motion.wheel = 50;
  motion.right_px = 900;
  for (int i = 0; i < 100; ++i) X_WD = drag_probe(X_WD, motion, camera, {}, 0.016);
  EXPECT_LE((X_WD.p - camera.target_W).norm(), 0.40 + 1e-9);
}

TEST(ProbeDrag, TheOfferedProbeIsInFrontOfTheCaseAndItsShaftComesTowardsTheViewer) {
  Random random(9);
  Aabb bounds;
  bounds.include(Vec3(-0.03, -0.08, -0.02));
  bounds.include(Vec3(0.03, 0.08, 0.02));
  for (int i = 0; i < 100; ++i) {
    Camera camera = some_camera(random);
    camera.target_W = bounds.center();
    const Pose X_WD = offered_probe(camera, bounds);
    const Vec3 towards_W = camera.q_WC * Vec3::UnitZ();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? bounds.hi.x() : bounds.lo.x(),
                   corner & 2 ? bounds.hi.y() : bounds.lo.y(),
                   corner & 4 ? bounds.hi.z() : bounds.lo.z());
      EXPECT_GT((X_WD.p - p).dot(towards_W), 0.009);
    }
    EXPECT_GT((X_WD.q * Vec3::UnitZ()).dot(towards_W), 0.5);
    EXPECT_GT((camera.q_WC.conjugate() * X_WD.q * Vec3::UnitZ()).y(), 0.2);
  }
}

TEST(ProbeDrag, AProbeThatIsBroughtIntoACloseUpIsInItsPicture) {
  Random random(10);
  Aabb limb;
  limb.include(Vec3(-0.08, -0.08, -0.4));
  limb.include(Vec3(0.08, 0.08, 0.4));
  for (int i = 0; i < 100; ++i) {
    Camera camera = some_camera(random);
    camera.target_W = 0.05 * random.direction();
    camera.distance_m = random.uniform(0.05, 0.6);
    const Pose X_WD = probe_in_picture(camera, limb);
    const Vec3 p_C = camera.q_WC.conjugate() * (X_WD.p - camera.target_W);
    EXPECT_TRUE(shows(camera, 0.5, X_WD.p));
    EXPECT_GE(p_C.z(), -1e-12);
    EXPECT_LE(p_C.z(), 0.5 * camera.distance_m + 1e-12);
  }
}

TEST(ProbeDrag, WhatIsBesideThePictureOrBehindTheEyeDoesNotShow) {
  Camera camera;
  const double edge = camera.half_height_m();
  EXPECT_TRUE(shows(camera, 2, Vec3(1.99 * edge, 0.99 * edge, 0)));
  EXPECT_FALSE(shows(camera, 2, Vec3(2.01 * edge, 0, 0)));
  EXPECT_FALSE(shows(camera, 2, Vec3(0, -1.01 * edge, 0)));
  EXPECT_TRUE(shows(camera, 2, Vec3(0, -1.01 * edge, -0.1 * camera.distance_m)));
  EXPECT_FALSE(shows(camera, 2, Vec3(0, 0, 1.1 * camera.distance_m)));
  camera.orthographic = true;
  EXPECT_FALSE(shows(camera, 2, Vec3(0, -1.01 * edge, -0.1 * camera.distance_m)));
}

TEST(CameraControl, ADragOrbitsAClickDoesNot) {
  CameraControl control;
  Camera camera;
  camera.q_WC = look_rotation(Vec3::UnitX(), Vec3::UnitZ());
  SceneInput input;
  input.dt_s = 0.016;
  input.left = true;
  EXPECT_EQ(control.update(camera, input, {}).q_WC.coeffs(), camera.q_WC.coeffs());
  input.dx = 2;
  control.update(camera, input, {});
  input.left = false;
  input.dx = 0;
  control.update(camera, input, {});
  EXPECT_TRUE(control.clicked());

  input.left = true;
  control.update(camera, input, {});
  input.dx = 40;
  const Camera turned = control.update(camera, input, {});
  EXPECT_GT(turned.q_WC.angularDistance(camera.q_WC), 0.05);
  EXPECT_NEAR(turned.distance_m, camera.distance_m, 1e-12);
  input.left = false;
  control.update(turned, input, {});
  EXPECT_FALSE(control.clicked());
}

TEST(CameraControl, ADragThatBeganOnAPanelMovesNothing) {
  CameraControl control;
  const Camera camera;
  SceneInput input;
  input.left = true;
  input.over_panels = true;
  control.update(camera, input, {});
  input.over_panels = false;
  input.dx = 100;
  EXPECT_EQ(control.update(camera, input, {}).q_WC.coeffs(), camera.q_WC.coeffs());
  input.left = false;
  control.update(camera, input, {});
  EXPECT_FALSE(control.clicked());
}

TEST(CameraControl, AFlightEndsExactlyAndADragEndsItEarly) {
  CameraControl control;
  Camera from, to;
  to.target_W = Vec3(0.01, 0.02, 0.03);
  to.distance_m = 0.1;
  to.q_WC = look_rotation(Vec3::UnitX(), Vec3::UnitZ());
  control.fly_to(from, to);
  SceneInput input;
  input.dt_s = 0.05;
  Camera camera = from;
  for (int i = 0; i < 10; ++i) camera = control.update(camera, input, {});
  EXPECT_NEAR((camera.target_W - to.target_W).norm(), 0, 1e-15);
  EXPECT_NEAR(camera.q_WC.angularDistance(to.q_WC), 0, 1e-7);
  control.fly_to(camera, from);
  input.wheel = 1;
  const Camera zoomed = control.update(camera, input, {});
  EXPECT_LT(zoomed.distance_m, camera.distance_m);
  input.wheel = 0;
  EXPECT_EQ(control.update(zoomed, input, {}).distance_m, zoomed.distance_m);
}

}  // namespace
}  // namespace osteon
