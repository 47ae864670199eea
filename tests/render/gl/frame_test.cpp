#include "gl/frame.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

ViewState any_view(Random& random) {
  ViewState view;
  view.camera.q_WC = random.rotation();
  view.camera.target_W = random.direction();
  view.camera.distance_m = random.uniform(0.2, 0.6);
  return view;
}

TEST(Frame, ClipSpaceAgreesWithProject) {
  Random random(21);
  const Viewport viewport{0, 0, 400, 300};
  for (int k = 0; k < 200; ++k) {
    ViewState view = any_view(random);
    view.camera.orthographic = k % 2 == 1;
    Aabb content;
    content.include(view.camera.target_W - Vec3::Constant(0.05));
    content.include(view.camera.target_W + Vec3::Constant(0.05));
    const Frame frame = make_frame(view, viewport.aspect(), content, {}, 400, 300);
    const Vec3 p_W = view.camera.target_W + 0.05 * random.direction();
    const Eigen::Vector4d clip =
        frame.clip_from_view.cast<double>() * (frame.X_CW * p_W).homogeneous();
    const Vec3 ndc = clip.head<3>() / clip.w();
    const PixelPoint p = *project(view.camera, viewport, p_W);
    EXPECT_NEAR(0.5 * (ndc.x() + 1) * 400, p.x, 1e-3);
    EXPECT_NEAR(0.5 * (1 - ndc.y()) * 300, p.y, 1e-3);
    EXPECT_LE(std::abs(ndc.z()), 1.0);
  }
}

TEST(Frame, AWindowShowsItsPartOfThePicture) {
  Random random(22);
  const ViewState view = any_view(random);
  Aabb content;
  content.include(view.camera.target_W);
  const Frame whole = make_frame(view, 1.5, content, {}, 300, 200);
  const Frame part = make_frame(view, 1.5, content, {0.5, 0.25, 0.25, 0.5}, 75, 100);
  const Eigen::Vector4d p_C =
      (whole.X_CW * Vec3(view.camera.target_W + 0.02 * random.direction())).homogeneous();
  const Eigen::Vector4d a = whole.clip_from_view.cast<double>() * p_C;
  const Eigen::Vector4d b = part.clip_from_view.cast<double>() * p_C;
  const auto across = [](double ndc) { return 0.5 * (ndc + 1); };
  EXPECT_NEAR(0.5 + 0.25 * across(b.x() / b.w()), across(a.x() / a.w()), 1e-6);
  EXPECT_NEAR(0.25 + 0.5 * across(b.y() / b.w()), across(a.y() / a.w()), 1e-6);
}

TEST(Frame, FinestPixelAgreesWithTheCamera) {
  Random random(24);
  const Viewport viewport{0, 0, 400, 300};
  for (int k = 0; k < 200; ++k) {
    ViewState view = any_view(random);
    view.camera.orthographic = k % 2 == 1;
    const Vec3 center_W = view.camera.target_W;
    Aabb content;
    content.include(center_W);
    const Frame frame = make_frame(view, viewport.aspect(), content, {}, 400, 300);
    const double expected = metres_per_pixel(view.camera, viewport, center_W);
    EXPECT_NEAR(finest_metres_per_pixel(frame, center_W, 0), expected, 1e-5 * expected);
    EXPECT_LE(finest_metres_per_pixel(frame, center_W, 0.01), expected * (1 + 1e-5));
  }
}

// A shaft of 200 mm across the picture, 60 mm before the eye: the ball about it reaches the eye.
TEST(Frame, AShaftAcrossThePictureIsAsNearAsItIs) {
  TriMesh shaft;
  for (int k = 0; k <= 100; ++k)
    for (const double side : {-0.005, 0.005})
      shaft.vertices.emplace_back(0.002 * k - 0.1, side, side);
  ViewState view;
  view.camera.orthographic = false;
  Aabb content;
  content.include(view.camera.target_W);
  const Frame frame = make_frame(view, 1.5, content, {}, 300, 200);
  const std::vector<ExtentBox> boxes = extent_boxes(shaft);
  const auto finest = [&](double depth_m) {
    const Pose X_WB = frame.X_CW.inverse() * Pose{Vec3(0, 0, -depth_m), Quat::Identity()};
    return finest_metres_per_pixel(frame, X_WB, boxes);
  };
  const auto at = [&](double depth_m) {
    return finest_metres_per_pixel(frame, frame.X_CW.inverse() * Vec3(0, 0, -depth_m), 0);
  };
  EXPECT_NEAR(finest(0.06), at(0.055), 1e-9);
  EXPECT_LT(finest_metres_per_pixel(frame, frame.X_CW.inverse() * Vec3(0, 0, -0.06), 0.1),
            at(0.002));
  EXPECT_NEAR(finest(0), at(0), 1e-9) << "the eye is in it";
  EXPECT_NEAR(finest(-0.5), at(0), 1e-9) << "behind the eye nothing is seen";
}

TEST(Frame, NoBallIsLostThatReachesIntoThePicture) {
  Random random(23);
  const Viewport viewport{0, 0, 400, 300};
  int out_of_sight = 0;
  for (int k = 0; k < 3000; ++k) {
    ViewState view = any_view(random);
    view.camera.orthographic = k % 2 == 1;
    const Vec3 center_W = view.camera.target_W + 0.2 * random.direction();
    Aabb content;
    content.include(center_W);
    const Frame frame = make_frame(view, viewport.aspect(), content, {}, 400, 300);
    const bool seen = in_sight(frame, center_W, 0.02);
    if (!seen) ++out_of_sight;
    for (int sample = 0; sample < 20; ++sample) {
      const auto p = project(view.camera, viewport, center_W + 0.02 * random.direction());
      const bool inside = p && p->x >= 0 && p->y >= 0 && p->x < 400 && p->y < 300;
      ASSERT_TRUE(seen || !inside);
    }
  }
  EXPECT_GT(out_of_sight, 300);
}

}  // namespace
}  // namespace osteon
