#include "osteon/surgeon/tour_surgeon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// A block of 20 mm about the origin, a mark on its top and one under it, a portal above.
Case block_under_portal() {
  BoneDef def;
  def.name = "block";
  def.felt = Felt::kHull;
  for (int i = 0; i < 8; ++i)
    def.mesh.vertices.push_back(
        Vec3((i & 1) ? 0.01 : -0.01, (i & 2) ? 0.01 : -0.01, (i & 4) ? 0.01 : -0.01));
  def.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  CaseDef c;
  c.name = "block";
  c.bones = {def};
  c.landmarks = {
      {"portal_a", {0.002, 0, 0.025}}, {"top", {0, 0, 0.0101}}, {"under", {0, 0, -0.0101}}};
  auto made = build_case(std::move(c));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

TourTool hook() { return {"probe", {}, Vec3(0.002, 0, 0), 0.00075, 0.0005, {}}; }
TourTool scope() {
  return {"scope", ScopeOptics{std::numbers::pi / 6, 0.65}, Vec3::Zero(), 0.00095, 0.00095, {}};
}

TEST(TourPlace, ItsShaftPassesThePortal) {
  const TourPlace place{{0.001, 0.002, 0.003}, Quat(0.5, 0.5, -0.5, 0.5), 0.008};
  const Pose pose = pose_at(place, hook());
  EXPECT_NEAR((pose * Vec3(0.002, 0, 0.008) - place.portal_W).norm(), 0, 1e-15);
}

TEST(TourPlace, ATouchPutsTheHooksTipOnTheBoneSquarely) {
  const Case c = block_under_portal();
  const auto place = find_touch(c, hook(), c.landmarks[0].p_W, 0, nullptr, 1);
  ASSERT_TRUE(place);
  const Pose pose = pose_at(*place, hook());
  EXPECT_NEAR(pose.p.z(), 0.0105, 1e-9);
  EXPECT_LE(std::max(std::abs(pose.p.x()), std::abs(pose.p.y())), 0.01);
  EXPECT_GT(pose.rotate(Vec3::UnitZ()).z(), 0.75);
  EXPECT_FALSE(find_touch(c, hook(), Vec3(0, 0, 0.2), 0, nullptr, 1));  // too far
}

TEST(TourPlace, ALookHasTheMarkNearTheMiddleFromAFittingDistance) {
  const Case c = block_under_portal();
  const TourGaze gaze{c.landmarks[1].p_W, 0.003, 0.015};
  const auto place = find_look(c, scope(), c.landmarks[0].p_W, gaze);
  ASSERT_TRUE(place);
  const ScopeView view = view_through(*scope().optics, pose_at(*place, scope()));
  const Vec3 way = gaze.at_W - view.eye_W;
  EXPECT_GT(way.norm(), 0.003);
  EXPECT_LT(way.norm(), 0.015);
  EXPECT_GT(way.normalized().dot(view.along_W), std::cos(0.5 * 0.65));
  EXPECT_FALSE(find_look(c, scope(), c.landmarks[0].p_W, {c.landmarks[2].p_W, 0.003, 0.015}));
}

}  // namespace
}  // namespace osteon
