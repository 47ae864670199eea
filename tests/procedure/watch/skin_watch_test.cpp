#include "osteon/procedure/skin_watch.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

struct SkinWatchRig {
  SkinWatch watch;
  BoneSnapshot bones;
  ToolState first, second;
  std::vector<Event> step() {
    std::vector<Event> out;
    ++second.tick;
    const std::array<const ToolState*, 2> tools{&first, &second};
    watch.add(tools, bones, out);
    return out;
  }
};

TEST(SkinWatch, WithoutABladeNothingIsTold) {
  SkinWatchRig rig;
  rig.bones.softs.skin.open_m = 0.03;
  EXPECT_TRUE(rig.step().empty());
  EXPECT_TRUE(rig.step().empty());
}

TEST(SkinWatch, AStrokeIsToldOnceAtItsEndWithItsWorst) {
  SkinWatchRig rig;
  SkinOpening& skin = rig.bones.softs.skin;
  skin.blades[1] = {true, 0.002, 0.001};
  EXPECT_TRUE(rig.step().empty());
  skin.blades[1] = {true, 0.009, 0};
  EXPECT_TRUE(rig.step().empty());
  skin.blades[1] = {true, 0.001, 0};
  skin.open_m = 0.026;
  EXPECT_TRUE(rig.step().empty());
  skin.blades[1] = {};
  const auto told = rig.step();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kSkinOpened);
  EXPECT_EQ(told[0].hand, 1);
  EXPECT_EQ(told[0].tick, 4u);
  EXPECT_NEAR(told[0].values[0], 26, 1e-9);
  EXPECT_NEAR(told[0].values[1], 9, 1e-9);
  EXPECT_NEAR(told[0].values[2], 1, 1e-9);
  EXPECT_TRUE(rig.step().empty());
  // The next one begins anew.
  skin.blades[1] = {true, 0.003, 0};
  EXPECT_TRUE(rig.step().empty());
  skin.blades[1] = {};
  EXPECT_NEAR(rig.step().at(0).values[1], 3, 1e-9);
}

TEST(SkinWatch, TwoBladesAreTwoStrokes) {
  SkinWatchRig rig;
  rig.bones.softs.skin.blades[0] = {true, 0.004, 0};
  rig.bones.softs.skin.blades[1] = {true, 0.005, 0};
  rig.step();
  rig.bones.softs.skin.blades[0] = {};
  rig.bones.softs.skin.blades[1] = {};
  EXPECT_EQ(rig.step().size(), 2u);
}

}  // namespace
}  // namespace osteon
