#include "segment/slice_plane.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

GridFrame scan_frame() {
  GridFrame frame;
  frame.size = {40, 30, 20};
  frame.spacing_m = Vec3(0.0005, 0.0007, 0.002);
  frame.origin_P = Vec3(0.01, -0.02, 0.3);
  return frame;
}

/// Patient's direction that the screen's right, or down, shows.
Vec3 screen_P(const SlicePlane& plane, const GridFrame& frame, bool right) {
  const SliceWindow window = whole_slice(plane, frame, 300, 200);
  const Vec3 from = frame.point_P(voxel_at(plane, frame, window, 100, 100, 3));
  const Vec3 to =
      frame.point_P(voxel_at(plane, frame, window, right ? 150 : 100, right ? 100 : 150, 3));
  return (to - from).normalized();
}

Vec3 direction(char letter) {
  switch (letter) {
    case 'L':
      return Vec3::UnitX();
    case 'R':
      return -Vec3::UnitX();
    case 'P':
      return Vec3::UnitY();
    case 'A':
      return -Vec3::UnitY();
    case 'S':
      return Vec3::UnitZ();
    default:
      return -Vec3::UnitZ();
  }
}

void expect_letters_true(const GridFrame& frame, double least) {
  for (const SlicePlane& plane : slice_planes(frame)) {
    const Vec3 right = screen_P(plane, frame, true), down = screen_P(plane, frame, false);
    EXPECT_GE(right.dot(direction(plane.right_letter)), least) << name_of(plane.view);
    EXPECT_GE(right.dot(-direction(plane.left_letter)), least);
    EXPECT_GE(down.dot(direction(plane.bottom_letter)), least);
    EXPECT_GE(down.dot(-direction(plane.top_letter)), least);
  }
}

TEST(SlicePlanes, LettersSayWhereThePatientIsHoweverTheScanLies) {
  GridFrame frame = scan_frame();
  expect_letters_true(frame, 1 - 1e-12);
  // Every way of laying three axes along the patient's, mirror images left out.
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (const int s : {-1, 1})
        for (const int t : {-1, 1}) {
          if (a == b) continue;
          Mat3 axes = Mat3::Zero();
          axes(a, 0) = s;
          axes(b, 1) = t;
          axes.col(2) = axes.col(0).cross(axes.col(1));
          frame.axes_P = axes;
          expect_letters_true(frame, 1 - 1e-12);
        }
}

TEST(SlicePlanes, AnObliqueScanGetsTheNearestLetters) {
  GridFrame frame = scan_frame();
  frame.axes_P = Eigen::AngleAxisd(0.6, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  expect_letters_true(frame, 0.7);
  // Turned by 45 degrees two axes are as near: each is still given away once.
  frame.axes_P = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()).toRotationMatrix();
  const auto planes = slice_planes(frame);
  EXPECT_NE(planes[0].normal, planes[1].normal);
  EXPECT_NE(planes[1].normal, planes[2].normal);
  EXPECT_NE(planes[0].normal, planes[2].normal);
}

TEST(SliceWindow, ShowsTheWholeSliceWithBothAxesAtOneScale) {
  const GridFrame frame = scan_frame();
  for (const SlicePlane& plane : slice_planes(frame)) {
    const SliceWindow window = whole_slice(plane, frame, 300, 200);
    const Vec3 last(frame.size[0] - 0.51, frame.size[1] - 0.51, frame.size[2] - 0.51);
    for (const Vec3& corner : {Vec3(-0.49, -0.49, -0.49), last}) {
      const PanePoint p = pane_point(plane, frame, window, corner);
      EXPECT_GE(p.x, 0);
      EXPECT_LE(p.x, 300);
      EXPECT_GE(p.y, 0);
      EXPECT_LE(p.y, 200);
    }
    const auto at = [&](double x, double y) {
      return frame.point_P(voxel_at(plane, frame, window, x, y, 0));
    };
    EXPECT_NEAR((at(10, 0) - at(0, 0)).norm(), (at(0, 10) - at(0, 0)).norm(), 1e-12);
  }
}

TEST(SliceWindow, PixelsAndVoxelsAreEachOthersInverse) {
  GridFrame frame = scan_frame();
  frame.axes_P << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (const SlicePlane& plane : slice_planes(frame)) {
    const SliceWindow window =
        zoomed(plane, frame, whole_slice(plane, frame, 320, 240), 0.3, 50, 70);
    const Vec3 voxel = voxel_at(plane, frame, window, 123, 45, 7);
    EXPECT_DOUBLE_EQ(voxel[plane.normal], 7);
    const PanePoint back = pane_point(plane, frame, window, voxel);
    EXPECT_NEAR(back.x, 123, 1e-9);
    EXPECT_NEAR(back.y, 45, 1e-9);
  }
}

TEST(SliceWindow, ZoomKeepsThePlaceUnderThePointerAndIsBounded) {
  const GridFrame frame = scan_frame();
  const SlicePlane plane = slice_planes(frame)[0];
  SliceWindow window = whole_slice(plane, frame, 300, 200);
  const Vec3 before = voxel_at(plane, frame, window, 40, 150, 2);
  window = zoomed(plane, frame, window, 0.5, 40, 150);
  EXPECT_NEAR((voxel_at(plane, frame, window, 40, 150, 2) - before).norm(), 0, 1e-9);
  for (int n = 0; n < 100; ++n) window = zoomed(plane, frame, window, 0.5, 40, 150);
  EXPECT_GT(window.m_per_px, 1e-6);
  for (int n = 0; n < 200; ++n) window = zoomed(plane, frame, window, 2, 40, 150);
  EXPECT_LT(window.m_per_px, 1);
  const SliceWindow moved = panned(plane, frame, window, 12, -5);
  const PanePoint p = pane_point(plane, frame, window, before);
  const PanePoint q = pane_point(plane, frame, moved, before);
  EXPECT_NEAR(q.x - p.x, 12, 1e-6);
  EXPECT_NEAR(q.y - p.y, -5, 1e-6);
}

TEST(SliceWindow, APaneWithoutSizeIsAPixel) {
  const GridFrame frame = scan_frame();
  const SliceWindow window = whole_slice(slice_planes(frame)[0], frame, 0, -3);
  EXPECT_EQ(window.width, 1);
  EXPECT_EQ(window.height, 1);
}

}  // namespace
}  // namespace osteon
