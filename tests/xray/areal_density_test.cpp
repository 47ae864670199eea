// Phantoms against their closed forms; then what makes rays go wrong.
#include "osteon/xray/areal_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "phantoms.h"

namespace osteon {
namespace {

using namespace testing_xray;

/// Checks every pixel, by a share of its own value; of rays shorter than 1 cm, at the rim, where a
/// polyhedron and its ideal differ, by that share of 1 cm. Returns how many met the phantom.
template <class Chord>
int expect_chords(const ArealDensity& got, const XrayView& view, double density,
                  const Chord& chord_m, double within) {
  const std::vector<float> total = got.total();
  int checked = 0;
  for (int row = 0; row < view.height; ++row)
    for (int column = 0; column < view.width; ++column) {
      const double want = 100 * density * chord_m(ray_W(view, column, row));
      const double is =
          static_cast<double>(total[static_cast<std::size_t>(row * view.width + column)]);
      EXPECT_NEAR(is, want, within * std::max(want, density)) << column << ", " << row;
      checked += want > 0;
    }
  return checked;
}

TEST(ArealDensity, NothingCastsNoShadow) {
  const auto got = areal_density({}, view_from_above(16));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->total(), std::vector<float>(256, 0.0f));
}

TEST(ArealDensity, ABoxIsItsChords) {
  const Vec3 lo(-0.011, -0.02, -0.013), hi(0.017, 0.009, 0.021);
  const XrayView view = view_from_above();
  const auto got = areal_density({{layer(box(lo, hi), 1.9)}}, view);
  ASSERT_TRUE(got);
  const int checked = expect_chords(
      *got, view, 1.9, [&](const Vec3& d) { return chord_in_box(view.source_W, d, lo, hi); }, 5e-4);
  EXPECT_GT(checked, 2000);
}

TEST(ArealDensity, ABallIsItsChords) {
  const Vec3 center(0.004, -0.003, 0.05);
  const XrayView view = view_from_above();
  const auto got = areal_density({{layer(ball(center, 0.02, 400), 1.3)}}, view);
  ASSERT_TRUE(got);
  const int checked = expect_chords(
      *got, view, 1.3, [&](const Vec3& d) { return chord_in_ball(view.source_W, d, center, 0.02); },
      0.005);
  EXPECT_GT(checked, 2000);
}

TEST(ArealDensity, AWedgeFallsEvenly) {
  const Vec3 lo(-0.02, -0.015, 0), hi(0.02, 0.015, 0.03);
  const XrayView view = view_from_above();
  const auto got = areal_density({{layer(wedge(lo, hi), 1.9)}}, view);
  ASSERT_TRUE(got);
  const Vec3 slope = Vec3(hi.z() - lo.z(), 0, hi.x() - lo.x());
  const auto chord = [&](const Vec3& d) {
    // The box's chord, cut where the ray goes under the sloping face.
    const double t = slope.dot(Vec3(lo.x(), 0, hi.z()) - view.source_W) / slope.dot(d);
    const Vec3 at = view.source_W + t * d;
    return chord_in_box(at, d, lo, hi);
  };
  EXPECT_GT(expect_chords(*got, view, 1.9, chord, 5e-4), 2000);
}

/// Pixels whose middles lie right on vertices, edges and silhouettes: an even grid of quads, its
/// lines on the middles of pixels.
TEST(ArealDensity, SharedEdgesAreCountedOnce) {
  XrayView view = view_from_above(17, 0.001);
  view.detector_center_W = Vec3(0, 0, 0);  // the grid lies in the detector's plane, but 1 mm
  view.source_W = Vec3(0, 0, 1);
  const Vec3 lo(-0.004, -0.004, 0), hi(0.004, 0.004, 0.001);
  const auto got = areal_density({{layer(box(lo, hi), 1)}}, view);
  ASSERT_TRUE(got);
  const std::vector<float> total = got->total();
  for (int row = 0; row < 17; ++row)
    for (int column = 0; column < 17; ++column) {
      const float is = total[static_cast<std::size_t>(row * 17 + column)];
      const int aside = std::max(std::abs(row - 8), std::abs(column - 8));
      if (aside < 4) {
        EXPECT_NEAR(is, 0.1f, 1e-5f) << column << ", " << row;
      } else if (aside == 4) {
        EXPECT_LE(is, 0.1001f) << column << ", " << row;
      } else {
        EXPECT_EQ(is, 0.0f) << column << ", " << row;
      }
    }
}

TEST(ArealDensity, TheFirstLayerIsThereWhereTheyOverlap) {
  const XrayView view = view_from_above(33);
  const TriMesh lower = box({-0.01, -0.01, 0}, {0.01, 0.01, 0.02});
  const TriMesh upper = box({-0.01, -0.01, 0.01}, {0.01, 0.01, 0.03});
  const auto got = areal_density(
      {{layer(upper, 8, XraySubstance::kIron), layer(lower, 1, XraySubstance::kSoft)}}, view);
  ASSERT_TRUE(got);
  const std::size_t middle = 16 * 33 + 16;
  EXPECT_NEAR(got->of[static_cast<std::size_t>(XraySubstance::kIron)][middle], 16, 1e-4);
  EXPECT_NEAR(got->of[static_cast<std::size_t>(XraySubstance::kSoft)][middle], 1, 1e-4);
}

TEST(ArealDensity, SurfacesOfALayerThatOverlapCountOnce) {
  const XrayView view = view_from_above(33);
  XrayLayer both = layer(box({-0.01, -0.01, 0}, {0.01, 0.01, 0.02}), 1);
  XraySurface again = both.surfaces[0];
  again.X_WM.p = Vec3(0, 0, 0.01);
  both.surfaces.push_back(again);
  const auto got = areal_density({{both}}, view);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->total()[16 * 33 + 16], 3, 1e-4);
}

TEST(ArealDensity, AHollowHoldsNothing) {
  TriMesh shell = ball(Vec3::Zero(), 0.02);
  const TriMesh hollow = ball(Vec3::Zero(), 0.01);
  const auto first = static_cast<std::uint32_t>(shell.vertices.size());
  shell.vertices.insert(shell.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (const Triangle& t : hollow.triangles)
    shell.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  const auto got = areal_density({{layer(shell, 1)}}, view_from_above(33));
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->total()[16 * 33 + 16], 2, 0.01);
}

// The two walls of a nail with a locking hole across it. Seen along the hole it is a perfect circle
// within a pixel, that of the rim farthest from the source; a few degrees beside, a lens. A surgeon
// finds the direction of the hole by this.
struct LockingHole {
  static constexpr double kRadius = 0.0025, kNail = 0.0055, kWall = 0.002;
  XrayView view = view_from_above(201, 0.0001);
  std::vector<float> total;

  explicit LockingHole(double tilt_rad) {
    view.detector_center_W = Vec3(0, 0, -0.4);
    XrayLayer nail =
        layer(washer(kRadius, 0.006, kNail - kWall, kNail), 4.43, XraySubstance::kTitanium);
    nail.surfaces.push_back(
        {std::make_shared<const TriMesh>(washer(kRadius, 0.006, -kNail, kWall - kNail)), Pose{}});
    for (XraySurface& s : nail.surfaces)
      s.X_WM.q = Quat(Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()));
    const auto got = areal_density({{nail}}, view);
    EXPECT_TRUE(got);
    if (got) total = got->total();
  }
  // Pixels from the middle to the first that metal darkens.
  double reach(double angle) const {
    for (double r = 0; r < 100; r += 0.05) {
      const int column = static_cast<int>(std::lround(100 + r * std::cos(angle)));
      const int row = static_cast<int>(std::lround(100 + r * std::sin(angle)));
      if (total[static_cast<std::size_t>(row * view.width + column)] > 0) return r;
    }
    return 100;
  }
};

TEST(ArealDensity, ALockingHoleIsAPerfectCircleAlongItsAxisAlone) {
  const LockingHole along(0);
  ASSERT_FALSE(along.total.empty());
  const double per_m = 1.0 / (0.6 + LockingHole::kNail) / along.view.pixel_m;
  for (int k = 0; k < 72; ++k)
    EXPECT_NEAR(along.reach(k * std::numbers::pi / 36), LockingHole::kRadius * per_m, 1) << k;
  const double tilt = 4 * std::numbers::pi / 180;
  const LockingHole beside(tilt);
  const double right = beside.reach(0) + beside.reach(std::numbers::pi);
  const double up = beside.reach(std::numbers::pi / 2) + beside.reach(-std::numbers::pi / 2);
  EXPECT_NEAR(right - up, 2 * LockingHole::kNail * std::sin(tilt) * per_m, 3);
  EXPECT_GT(right - up, 8) << "told from a circle at a glance";
}

TEST(ArealDensity, NothingBeyondTheDetectorOrBehindTheSourceCounts) {
  const XrayView view = view_from_above(33);
  const auto got = areal_density({{layer(box({-0.1, -0.1, -0.5}, {0.1, 0.1, -0.3}), 1),
                                   layer(box({-0.1, -0.1, 0.65}, {0.1, 0.1, 0.8}), 5)}},
                                 view);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->total()[16 * 33 + 16], 10, 1e-3);
}

TEST(ArealDensity, ABodyAroundTheSourceIsCutAtIt) {
  const XrayView view = view_from_above(33);
  const auto got = areal_density({{layer(box({-0.1, -0.1, 0.5}, {0.1, 0.1, 0.8}), 1)}}, view);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->total()[16 * 33 + 16], 10, 1e-3);
}

TEST(ArealDensity, TheSameBitsHoweverTheTasksRun) {
  const XrayView view = view_from_above(100);
  const XrayBody body = {{layer(ball({0.002, 0, 0}, 0.02), 1), layer(ball({0, 0, 0}, 0.025), 2)}};
  const auto forwards = areal_density(body, view);
  const auto backwards = areal_density(
      body, view, [](std::size_t count, const std::function<void(std::size_t)>& task) {
        while (count-- > 0) task(count);
      });
  ASSERT_TRUE(forwards && backwards);
  EXPECT_EQ(forwards->of, backwards->of);
}

TEST(ArealDensity, BadViewsAndBodiesAreRefused) {
  XrayView view = view_from_above();
  view.u_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(areal_density({}, view));
  view = view_from_above();
  view.width = 0;
  EXPECT_FALSE(areal_density({}, view));
  view = view_from_above();
  view.v_W = -view.v_W;  // mirrored
  EXPECT_FALSE(areal_density({}, view));
  XrayBody body = {{layer(ball(Vec3::Zero(), 0.01, 8), -1)}};
  EXPECT_FALSE(areal_density(body, view_from_above()));
  body.layers[0].material.density_g_per_cm3 = 1;
  body.layers[0].surfaces[0].X_WM.p.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(areal_density(body, view_from_above()));
}

TEST(XraySurface, ABrokenMeshIsRefusedByName) {
  const auto refused = [](TriMesh mesh, const std::string& why) {
    const auto got = xray_surface(std::move(mesh), "bone 'x'");
    return !got && got.error().where == "bone 'x'" &&
           got.error().what.find(why) != std::string::npos;
  };
  TriMesh mesh = box(Vec3::Zero(), Vec3::Ones());
  EXPECT_TRUE(refused({}, "no triangles"));
  TriMesh open = mesh;
  open.triangles.pop_back();
  EXPECT_TRUE(refused(open, "not closed"));
  TriMesh wild = mesh;
  wild.triangles[0][0] = 8;
  EXPECT_TRUE(refused(wild, "without its vertices"));
  mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(mesh, "not finite"));
}

TEST(XraySurface, OneThatFacesInwardsIsTurned) {
  TriMesh inwards = box({-0.01, -0.01, 0}, {0.01, 0.01, 0.02});
  for (Triangle& t : inwards.triangles) std::swap(t[0], t[1]);
  const auto surface = xray_surface(inwards, "x");
  ASSERT_TRUE(surface);
  const auto got =
      areal_density({{{"x", {XraySubstance::kSoft, 1}, {{*surface, {}}}}}}, view_from_above(33));
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->total()[16 * 33 + 16], 2, 1e-4);
}

}  // namespace
}  // namespace osteon
