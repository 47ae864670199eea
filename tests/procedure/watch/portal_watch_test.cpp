#include "osteon/procedure/portal_watch.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "osteon/base/turn.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// Skin at z = 0; both portals 30 mm apart along y, the tubercle 40 mm from them along x.
Case two_portals(bool with_tubercle = true) {
  BoneDef def;
  def.name = "block";
  def.felt = Felt::kHull;
  for (int i = 0; i < 8; ++i)
    def.mesh.vertices.push_back(
        Vec3((i & 1) ? 0.01 : -0.01, (i & 2) ? 0.005 : -0.005, (i & 4) ? -0.03 : -0.05));
  def.mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}, {0, 4, 1}, {1, 4, 5},
                        {2, 3, 6}, {3, 7, 6}, {0, 2, 4}, {2, 6, 4}, {1, 5, 3}, {3, 5, 7}};
  CaseDef c;
  c.name = "two portals";
  c.bones = {def};
  const Vec3 in = -Vec3::UnitZ();
  c.landmarks = {{"portal_al", {0, -0.015, 0}, in}, {"portal_am", {0, 0.015, 0}, in}};
  if (with_tubercle) c.landmarks.push_back({"tibial_tubercle", {0.04, 0.002, -0.01}});
  auto made = build_case(std::move(c));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

ToolState in_portal(std::uint32_t portal, std::uint32_t way, const Vec3& p_W) {
  ToolState tool;
  tool.tick = 7;
  tool.portal = portal;
  tool.portal_way = way;
  tool.p_portal_W = p_W;
  tool.X_WP.p = p_W - 0.010 * Vec3::UnitZ();
  return tool;
}

struct Rig {
  Case the_case = two_portals();
  PortalWatch watch{the_case, {{0, 0, 1}, {std::nullopt, ScopeOptics{0, 0.9}}}};
  std::vector<Event> add(const ToolState& worker, const ToolState& scope = {}) {
    std::vector<Event> out;
    const std::array<const ToolState*, 2> tools{&worker, &scope};
    watch.add(tools, rest_snapshot(the_case), out);
    return out;
  }
};

TEST(PortalWatch, OutsideOfPortalsAndInThoseOfTheCaseItTellsNothing) {
  Rig rig;
  EXPECT_TRUE(rig.add({}).empty());
  EXPECT_TRUE(rig.add(in_portal(0, 0, Vec3::Zero())).empty());
  EXPECT_TRUE(rig.add(in_portal(9, 1, Vec3::Zero())).empty());
  EXPECT_TRUE(rig.add(in_portal(0, 1, Vec3::Constant(std::nan("")))).empty());
}

TEST(PortalWatch, ACaseWithoutATubercleHasNoFrame) {
  EXPECT_FALSE(portal_frame(two_portals(false), 0));
  EXPECT_FALSE(portal_frame(two_portals(), 2));
  EXPECT_FALSE(portal_frame(two_portals(), 77));
}

// Instrument 2 of the tray.
ToolState needle_at(const Vec3& tip_W, const Vec3& back_W) {
  ToolState tool;
  tool.tick = 9;
  tool.instrument = 2;
  tool.X_WP = {tip_W, turn_between(Vec3::UnitZ(), back_W.normalized())};
  return tool;
}

TEST(PortalWatch, ANeedleIsToldWhereItsAxisGoesThroughTheSkin) {
  Rig rig;
  const Vec3 hole(0.002, 0.018, 0), back(0.3, 0, 1);
  const ToolState in = needle_at(hole - 0.02 * back, back);
  EXPECT_TRUE(rig.add(in).empty());  // nobody said that it is one
  rig.watch.set_needles({0, 0, 1});
  EXPECT_TRUE(rig.add(needle_at(hole - 0.005 * back, back)).empty());  // not in the joint
  EXPECT_TRUE(rig.add(needle_at(hole + 0.005 * back, back)).empty());
  EXPECT_TRUE(rig.add(needle_at(Vec3(0.002, 0.08, -0.02), back)).empty());     // far away
  EXPECT_TRUE(rig.add(needle_at(hole - 0.02 * back, Vec3(1, 0, 0))).empty());  // along the skin
  const auto told = rig.add(in);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kNeedleIn);
  EXPECT_EQ(told[0].subject, 1u);
  EXPECT_NEAR(told[0].values[0], -2, 1e-9);
  EXPECT_NEAR(told[0].values[1], -3, 1e-9);
  EXPECT_EQ(told[0].values[2], 0);
  EXPECT_TRUE(rig.add(in).empty());
  // A scope in its portal looks at the tip.
  ToolState scope = in_portal(0, 0, {0, -0.015, 0});
  scope.X_WP = {in.X_WP.p + Vec3(0, -0.02, 0), turn_between(Vec3::UnitZ(), -Vec3::UnitY())};
  const auto seen = rig.add(in, scope);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].values[2], 1);
  EXPECT_TRUE(rig.add(in, scope).empty());
  // How far from its hole a portal is.
  rig.add({});
  (void)rig.add(in_portal(2, 1, {0.002, 0.022, 0}));
  ASSERT_EQ(rig.watch.found().size(), 1u);
  ASSERT_TRUE(rig.watch.found()[0].from_needle_m);
  EXPECT_NEAR(*rig.watch.found()[0].from_needle_m, 0.004, 1e-9);
}

TEST(PortalWatch, ItSaysHowFarOffInTheKneesOwnDirections) {
  const Case c = two_portals();
  const auto al = portal_frame(c, 0), am = portal_frame(c, 1);
  ASSERT_TRUE(al && am);
  EXPECT_LT((al->up_W - Vec3(-1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((al->middle_W - Vec3(0, 1, 0)).norm(), 1e-9);
  EXPECT_LT((am->middle_W - Vec3(0, -1, 0)).norm(), 1e-9);
  Rig rig;
  // 3 mm towards the foot, 2 mm towards the middle.
  const auto events = rig.add(in_portal(1, 2, {0.003, -0.013, 0}));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, kPortalPlaced);
  EXPECT_EQ(events[0].subject_kind, SubjectKind::kLandmark);
  EXPECT_EQ(events[0].subject, 0u);
  EXPECT_EQ(events[0].hand, 0);
  EXPECT_EQ(events[0].tick, 7u);
  EXPECT_NEAR(events[0].values[0], -3, 1e-9);
  EXPECT_NEAR(events[0].values[1], 2, 1e-9);
  EXPECT_EQ(events[1].kind, kPortalWay);
  EXPECT_EQ(events[1].values[0], 1);
  EXPECT_EQ(events[1].values[1], 0);
  ASSERT_EQ(rig.watch.found().size(), 1u);
  const MadePortalFound& found = rig.watch.found()[0];
  EXPECT_EQ(found.landmark, 0u);
  EXPECT_LT((found.off_F - Vec3(0, -0.003, 0.002)).norm(), 1e-12);
  EXPECT_LT((found.shaft_F - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_TRUE(found.pierced);
  EXPECT_FALSE(found.seen);
}

TEST(PortalWatch, APortalIsToldOnceAndAnewWhenItWasMadeAnew) {
  Rig rig;
  ToolState tool = in_portal(0, 1, {0, -0.015, 0});
  EXPECT_EQ(rig.add(tool).size(), 2u);
  EXPECT_TRUE(rig.add(tool).empty());
  tool.p_portal_W.x() += 0.004;  // along its slit
  EXPECT_TRUE(rig.add(tool).empty());
  ++tool.epoch;  // the restore point has kept it
  EXPECT_TRUE(rig.add(tool).empty());
  ++tool.epoch;
  tool.p_portal_W.x() += 0.001;
  EXPECT_EQ(rig.add(tool).size(), 2u);
  EXPECT_EQ(rig.add(in_portal(2, 1, {0, 0.015, 0})).size(), 2u);
}

TEST(PortalWatch, TheTipIsSeenByAScopeThatIsInAPortalAndLooksThere) {
  const ToolState worker = in_portal(2, 1, {0, 0.015, 0});
  ToolState scope = in_portal(0, 1, {0, -0.015, 0});
  scope.X_WP.p = Vec3(0, -0.005, -0.010);
  scope.X_WP.q = turn_between(Vec3(-Vec3::UnitZ()), Vec3::UnitY());
  const auto seen = [&](const ToolState& by) {
    Rig rig;
    for (const Event& event : rig.add(worker, by))
      if (event.kind == kPortalWay && event.hand == 0) return event.values[1];
    return -1.0;
  };
  EXPECT_EQ(seen(scope), 1);
  ToolState outside = scope;
  outside.portal = kNoPortal;
  EXPECT_EQ(seen(outside), 0);
  ToolState away = scope;
  away.X_WP.q = turn_between(Vec3(-Vec3::UnitZ()), Vec3(-Vec3::UnitY()));
  EXPECT_EQ(seen(away), 0);
  ToolState behind = scope;  // the block is between
  behind.X_WP.p = Vec3(0, -0.030, -0.060);
  behind.X_WP.q = turn_between(Vec3(-Vec3::UnitZ()), Vec3(0, 0.045, 0.050).normalized());
  EXPECT_EQ(seen(behind), 0);
}

}  // namespace
}  // namespace osteon
