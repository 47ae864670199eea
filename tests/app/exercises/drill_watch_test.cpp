#include "exercises/drill_watch.h"

#include <gtest/gtest.h>

#include "osteon/procedure/tunnel_events.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// A block of 40 x 40 x 20 mm about the origin; its shafts come from above.
Case drilled_through_block() {
  BoneDef bone;
  bone.name = "tibia";
  for (int i = 0; i < 8; ++i)
    bone.mesh.vertices.push_back(
        Vec3((i & 1) ? 0.02 : -0.02, (i & 2) ? 0.02 : -0.02, (i & 4) ? 0.01 : -0.01));
  bone.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  CaseDef def;
  def.name = "block";
  def.bones = {bone};
  auto made = build_case(std::move(def));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

class DrillWatchTest : public ::testing::Test {
 protected:
  // Moves the tip from one height to another in steps of 0.1 mm each hundredth of a second.
  void lead(double from_m, double to_m, double power, std::uint32_t instrument) {
    const int steps = static_cast<int>(std::abs(to_m - from_m) / 0.0001 + 0.5);
    for (int n = 1; n <= steps; ++n) {
      const double z = from_m + (to_m - from_m) * n / steps;
      for (int k = 0; k < 10; ++k) tick(z, power, instrument);
    }
  }
  void tick(double z_m, double power, std::uint32_t instrument) {
    ToolState tool;
    tool.tick = ++tick_;
    tool.X_WP.p.z() = z_m;
    tool.power = power;
    tool.instrument = instrument;
    const ToolState* const all[] = {&tool};
    watch_.add(all, bones_, events_);
    done_ = done_ || watch_.take_done(1);
  }
  std::vector<double> told(EventKind kind) const {
    std::vector<double> values;
    for (const Event& event : events_)
      if (event.kind == kind) values.push_back(event.values[0]);
    return values;
  }
  void put_pin() {
    bones_.rods[0].kind = GuideRod::Kind::kPin;
    bones_.rods[0].bone = 0;
    bones_.rods[0].length_m = 0.3;
  }
  Case case_ = drilled_through_block();
  BoneSnapshot bones_ = rest_snapshot(case_);
  DrillWatch watch_{case_, {kNoSubject, 0}, {0.0024, 0.008}, 0.001, 1};
  std::vector<Event> events_;
  std::uint64_t tick_ = 0;
  bool done_ = false;
};

TEST_F(DrillWatchTest, WithoutAPinADrillIsToldOnceItIsDeep) {
  lead(0.015, 0.0075, 1, 1);
  EXPECT_TRUE(told(kDrilledFree).empty());
  lead(0.0075, 0, 1, 1);
  ASSERT_EQ(told(kDrilledFree).size(), 1u);
  EXPECT_NEAR(told(kDrilledFree)[0], 3, 0.2);
}

TEST_F(DrillWatchTest, ABoneThatIsDrilledDeepIsToldOnceWithAPinOrWithout) {
  put_pin();
  lead(0.015, 0.0075, 1, 1);
  EXPECT_TRUE(told(kBoneDrilled).empty());
  lead(0.0075, 0, 1, 1);
  lead(0, 0.015, 1, 1);
  lead(0.015, 0, 1, 1);
  EXPECT_EQ(told(kBoneDrilled).size(), 1u);
}

TEST_F(DrillWatchTest, OverAPinItIsDoneWhenDrillAndPinAreOut) {
  put_pin();
  lead(0.015, -0.013, 1, 1);
  lead(-0.013, 0.03, 0, 1);
  for (int n = 0; n < 1000; ++n) tick(0.03, 0, 1);
  EXPECT_TRUE(told(kDrilledFree).empty());
  EXPECT_FALSE(done_) << "the pin is still there";
  bones_.rods[0] = {};
  tick(0.03, 0, 1);
  for (int n = 0; n < 10; ++n) tick(0.03, 0, 1);
  EXPECT_TRUE(done_);
  ASSERT_EQ(told(kDrillPlunged).size(), 2u);  // 1 and 2 of 3 mm, less a step
  EXPECT_NEAR(told(kDrillPlunged).back(), 2.2, 0.3);
}

TEST_F(DrillWatchTest, APinAloneIsNoDrillAndADrillThatRestsDoesNothing) {
  lead(0.015, -0.02, 1, 0);
  lead(0.015, -0.02, 0, 1);
  for (int n = 0; n < 1000; ++n) tick(0.03, 0, 1);
  EXPECT_FALSE(done_);
  EXPECT_TRUE(told(kDrillPlunged).empty());
  EXPECT_TRUE(told(kDrilledFree).empty());
}

}  // namespace
}  // namespace osteon
