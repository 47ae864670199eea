#include "osteon/procedure/stump_watch.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "../../mesh/shapes.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// A block far below; a scope that looks straight down from above the origin, and a shaver.
struct StumpWatchRig {
  StumpWatchRig() {
    BoneDef block;
    block.name = "block";
    block.felt = Felt::kHull;
    block.mesh = test::sphere(0.005, 9, Vec3(0, 0, -0.1));
    CaseDef def;
    def.name = "block";
    def.bones = {block};
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built) << built.error().message();
    the_case.emplace(std::move(*built));
    watch.emplace(*the_case, std::vector<std::optional<ScopeOptics>>{ScopeOptics{0, 0.7}, {}});
    scope.portal = 0;
    scope.X_WP = {Vec3(0, 0, 0.03), Quat::Identity()};
    shaver.portal = 1;
    shaver.X_WP = {Vec3::Zero(), Quat::Identity()};
  }
  std::vector<Event> add(std::uint64_t tick, double percent) {
    std::vector<Event> out;
    BoneSnapshot bones = rest_snapshot(*the_case);
    bones.softs.cleared_percent = percent;
    scope.tick = shaver.tick = tick;
    const std::array<const ToolState*, 2> tools{&scope, &shaver};
    watch->add(tools, bones, obscured, out);
    return out;
  }
  std::optional<Case> the_case;
  std::optional<StumpWatch> watch;
  ToolState scope, shaver;
  bool obscured = false;
};

TEST(StumpWatch, WhereNothingIsFeltItTellsNothing) {
  StumpWatchRig rig;
  for (std::uint64_t tick = 1; tick <= 2 * kTellStumps; ++tick)
    EXPECT_TRUE(rig.add(tick, -1).empty());
  EXPECT_FALSE(rig.watch->percent());
  std::vector<Event> out;
  rig.watch->add({}, {}, false, out);
  EXPECT_TRUE(out.empty());
}

TEST(StumpWatch, WholePercentsAreToldOnceAndAgainForALaterStage) {
  StumpWatchRig rig;
  EXPECT_TRUE(rig.add(1, 0.4).empty());
  EXPECT_EQ(rig.watch->percent(), 0);
  const auto events = rig.add(2, 37.9);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, kStumpsCleared);
  EXPECT_EQ(events[0].tick, 2u);
  EXPECT_EQ(events[0].values[0], 37);
  EXPECT_TRUE(rig.add(3, 37.95).empty());
  EXPECT_EQ(rig.watch->percent(), 37);
  EXPECT_EQ(rig.add(kTellStumps, 37.95).size(), 1u);
}

TEST(StumpWatch, ARestorePointBringsThemBack) {
  StumpWatchRig rig;
  EXPECT_EQ(rig.add(1, 50).size(), 1u);
  const auto events = rig.add(2, 0);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].values[0], 0);
}

TEST(StumpWatch, WhatGoesWhileNobodySeesTheTipIsCountedApart) {
  StumpWatchRig rig;
  EXPECT_EQ(rig.add(1, 10)[0].values[1], 0);
  rig.scope.X_WP.q = Quat(Eigen::AngleAxisd(3, Vec3::UnitX()));  // looks away
  EXPECT_EQ(rig.add(2, 30)[0].values[1], 20);
  rig.scope.X_WP.q = Quat::Identity();
  EXPECT_EQ(rig.add(3, 45)[0].values[1], 20);
  rig.scope.portal = kNoPortal;  // lies beside the knee
  EXPECT_EQ(rig.add(4, 50)[0].values[1], 25);
  // What a restore point brings back was not cleared at all.
  EXPECT_EQ(rig.add(5, 5)[0].values[1], 5);
  rig.scope.portal = 0;
  rig.shaver.portal = kNoPortal;
  EXPECT_EQ(rig.add(6, 10)[0].values[1], 10);
  rig.shaver.portal = 1;
  EXPECT_EQ(rig.add(7, 20)[0].values[1], 10);
  rig.obscured = true;  // the joint has collapsed
  EXPECT_EQ(rig.add(8, 30)[0].values[1], 20);
}

TEST(StumpWatch, WhetherTheTipIsInThePictureIsKnownBeforeAnythingIsCleared) {
  StumpWatchRig rig;
  const std::vector<const ToolState*> tools{&rig.scope, &rig.shaver};
  const BoneSnapshot bones = rest_snapshot(*rig.the_case);
  EXPECT_EQ(rig.watch->is_tip_watched(tools, bones), true);
  rig.scope.X_WP.q = Quat(Eigen::AngleAxisd(3, Vec3::UnitX()));
  EXPECT_EQ(rig.watch->is_tip_watched(tools, bones), false);
  rig.shaver.portal = kNoPortal;
  EXPECT_FALSE(rig.watch->is_tip_watched(tools, bones)) << "nothing is in that could clear";
}

}  // namespace
}  // namespace osteon
