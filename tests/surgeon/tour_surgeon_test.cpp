#include "osteon/surgeon/tour_surgeon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/scene/build_case.h"
#include "osteon/scene/portal.h"

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

// A shaft that leans from the vertical by an angle, towards x.
TourPlace leaning(const Vec3& portal_W, double angle_rad, double depth_m = 0.005) {
  return {portal_W, Quat(Eigen::AngleAxisd(angle_rad, Vec3::UnitY())), depth_m};
}

TEST(TourPlace, TwoShaftsAreClearWhereNeitherMeetsTheOthersHandle) {
  const TourPlace upright = leaning(Vec3::Zero(), 0);
  EXPECT_FALSE(clear_of(upright, upright));
  EXPECT_FALSE(clear_of(upright, leaning(Vec3(0.010, 0, 0), 0)));
  EXPECT_TRUE(clear_of(upright, leaning(Vec3(0.030, 0, 0), 0)));
  EXPECT_TRUE(clear_of(upright, leaning(Vec3(0.010, 0, 0), 0.4)));
  EXPECT_FALSE(clear_of(upright, leaning(Vec3(0.010, 0, 0), -0.4)));  // they cross
}

TEST(TourPlace, AWayIsLiftedOverAShaftThatStandsInIt) {
  const TourPlace from = leaning(Vec3(-0.02, 0, 0), -0.4), to = leaning(Vec3(0.02, 0, 0), 0.4);
  EXPECT_EQ(lift_over(from, to, {}), std::optional(0.0));
  EXPECT_EQ(lift_over(from, to, {leaning(Vec3(0, 0.2, 0), 0)}), std::optional(0.0));
  const std::vector<TourPlace> between{leaning(Vec3(0, 0.001, 0), 0, 0.02)};
  const auto lift = lift_over(from, to, between);
  ASSERT_TRUE(lift);
  EXPECT_GT(*lift, 0.08);  // what is above the skin is 120 mm long
  for (int k = 1; k < 20; ++k)
    EXPECT_TRUE(clear_of(place_between(from, to, *lift, k / 20.0), between[0])) << k;
  EXPECT_FALSE(clear_of(place_between(from, to, 0, 0.5), between[0]));
  // It begins and ends over the portals, as they lean.
  for (const double lifted_m : {0.0, *lift}) {
    EXPECT_NEAR((place_between(from, to, lifted_m, 0).portal_W - from.portal_W).norm(), 0, 1e-15);
    EXPECT_NEAR((place_between(from, to, lifted_m, 1).portal_W - to.portal_W).norm(), 0, 1e-15);
    EXPECT_NEAR(place_between(from, to, lifted_m, 1).q.angularDistance(to.q), 0, 1e-7);
  }
}

TEST(TourPlace, AtItsPortalAShaftTurnsAsideFromOneThatIsThere) {
  const Case c = block_under_portal();
  const Vec3 portal_W = c.landmarks[0].p_W;
  const TourPlace wanted = leaning(portal_W, 0.5);
  const TourPlace far = leaning(portal_W + Vec3(0, 0.2, 0), 0);
  EXPECT_EQ(turned_clear(c, hook(), wanted, {far}).q.coeffs(), wanted.q.coeffs());
  const TourPlace other = leaning(portal_W + Vec3(0.008, 0, 0), 0.3);
  ASSERT_FALSE(clear_of(wanted, other));
  const TourPlace turned = turned_clear(c, hook(), wanted, {other});
  EXPECT_TRUE(clear_of(turned, other));
  // As steep as before, through the same portal.
  const Vec3 inwards_W = find_portals(c)[0].nhat_W;
  EXPECT_NEAR((turned.q * Vec3(Vec3::UnitZ())).dot(inwards_W),
              (wanted.q * Vec3(Vec3::UnitZ())).dot(inwards_W), 1e-9);
  EXPECT_EQ(turned.portal_W, portal_W);
}

// A way between places that are farther out than usual begins and ends there.
TEST(TourPlace, AWayFromFarOutBeginsThere) {
  const TourPlace far = leaning(Vec3::Zero(), 0.2, -0.06), in = leaning(Vec3(0.01, 0, 0), 0, 0.005);
  for (const double lift_m : {0.0, 0.03}) {
    EXPECT_NEAR(place_between(far, in, lift_m, 0).depth_m, -0.06, 1e-15);
    EXPECT_NEAR(place_between(far, in, lift_m, 1).depth_m, -kTourOut_m, 1e-15);
    EXPECT_NEAR(place_between(in, far, lift_m, 1).depth_m, -0.06, 1e-15);
  }
}

// Scope through a, hook through b, scope through c.
TourPlan three_changes(const Vec3& a_W, const Vec3& b_W, const Vec3& c_W) {
  Case c = block_under_portal();
  c.landmarks = {{"portal_a", a_W}, {"portal_b", b_W}, {"portal_c", c_W}};
  ScenarioPlan plan;
  plan.goals.emplace_back();
  for (std::uint32_t i = 0; i < 3; ++i) {
    PlannedRule goal;
    goal.rule = {"through", {}, {{"for_s", 0.5}}};
    goal.bones = {i};
    goal.about = SubjectKind::kLandmark;
    goal.hand = i == 1 ? 0 : 1;
    plan.goals.back().push_back(goal);
  }
  return plan_tour(plan, c, {}, {hook(), scope()});
}

TEST(TourPlan, AHookWaitsOverItsPortalWhereTheScopeMustPass) {
  using Kind = TourVisit::Kind;
  const Vec3 a_W(-0.010, 0, 0.025), b_W(0, 0, 0.025), c_W(0.002, 0, 0.025);
  const TourPlan plan = three_changes(a_W, b_W, c_W);
  ASSERT_EQ(plan.visits.size(), 4u);
  EXPECT_EQ(plan.visits[1].kind, Kind::kWaitOver);
  EXPECT_EQ(plan.visits[1].hand, 0u);
  EXPECT_LT(plan.visits[1].place.depth_m, -kTourOut_m);
  EXPECT_EQ(plan.visits[2].hand, 1u);
  EXPECT_EQ(plan.visits[3].kind, Kind::kEnter);
  EXPECT_EQ(plan.visits[3].place.portal_W, b_W);
  const TourPlace& waits = plan.visits[1].place;
  for (int k = 0; k <= 8; ++k)
    EXPECT_TRUE(
        clear_of(place_between(plan.visits[0].place, plan.visits[2].place, 0, k / 8.0), waits));
  // Where there is room all is done in its order.
  EXPECT_EQ(three_changes(a_W, b_W + Vec3(0, 0.08, 0), c_W).visits.size(), 3u);
}

}  // namespace
}  // namespace osteon
