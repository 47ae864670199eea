#include "osteon/procedure/knee_exam_watch.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

// A knee that gives 10 mm under the pull and 6 under the other load, less the more it is bent.
struct ExamWatchRig {
  std::vector<Event> see(double bend_deg, double pull, double pivot) {
    bones.exam.on = bones.bend.on = true;
    bones.exam.front_n = 134;
    bones.bend.now_deg = bend_deg;
    bones.exam.now = {pull, pivot};
    bones.exam.give.front_m = pull * 0.010 + pivot * (0.006 - 0.00005 * bend_deg);
    bones.exam.give.other_front_m = 0.004 * (pull + pivot);
    std::vector<Event> out;
    watch.add(++tick, bones, out);
    return out;
  }
  const std::optional<KneeTestFound>& found(KneeTest test) const {
    return watch.exam().found[bones.exam.knee][static_cast<std::size_t>(test)];
  }
  KneeExamWatch watch;
  BoneSnapshot bones;
  std::uint64_t tick = 0;
};

TEST(KneeExamWatch, SaysNothingOfAKneeThatNobodyLoads) {
  ExamWatchRig rig;
  std::vector<Event> out;
  rig.watch.add(1, BoneSnapshot{}, out);
  EXPECT_TRUE(out.empty());
  EXPECT_TRUE(rig.see(30, 0, 0).empty());
  EXPECT_FALSE(rig.watch.exam().any());
}

TEST(KneeExamWatch, TellsWhereABentKneeStandsStillOnceEachTime) {
  KneeExamWatch watch;
  BoneSnapshot bones;
  std::vector<Event> out;
  const auto see = [&](double now_deg, double wanted_deg) {
    bones.bend = {};
    bones.bend.on = true;
    bones.bend.now_deg = now_deg;
    bones.bend.wanted_deg = wanted_deg;
    out.clear();
    watch.add(1, bones, out);
    return out.size();
  };
  EXPECT_EQ(see(80, 80), 1u);
  EXPECT_EQ(out[0].kind, kKneeBent);
  EXPECT_EQ(out[0].values[0], 80);
  EXPECT_EQ(see(80, 80), 0u);
  EXPECT_EQ(see(80, 120), 0u);
  EXPECT_EQ(see(119.9, 120), 0u);
  EXPECT_EQ(see(120, 120), 1u);
  EXPECT_EQ(see(120, 120), 0u);
  ++bones.epoch;  // back to a restore point
  EXPECT_EQ(see(120, 120), 1u);
}

TEST(KneeExamWatch, ALachmanIsAFirmPullAtItsBend) {
  ExamWatchRig rig;
  EXPECT_TRUE(rig.see(30, 0.85, 0).empty());
  EXPECT_TRUE(rig.see(10, 1, 0).empty());
  EXPECT_TRUE(rig.see(50, 1, 0).empty());
  EXPECT_TRUE(rig.see(30, 1, 0.2).empty());
  const auto told = rig.see(30, 0.95, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kKneeExamined);
  EXPECT_EQ(told[0].values[0], 0);
  EXPECT_EQ(told[0].values[1], 0);
  EXPECT_NEAR(told[0].values[2], 9.5 - 3.8, 1e-9);
  // Told once; what the full pull adds is found as well.
  EXPECT_TRUE(rig.see(30, 1, 0).empty());
  ASSERT_TRUE(rig.found(KneeTest::kLachman));
  EXPECT_EQ(rig.found(KneeTest::kLachman)->flexion_deg, 30);
  EXPECT_NEAR(rig.found(KneeTest::kLachman)->front_m, 0.010, 1e-12);
  EXPECT_NEAR(rig.found(KneeTest::kLachman)->side_difference_m(), 0.006, 1e-12);
  EXPECT_FALSE(rig.found(KneeTest::kPivot));
}

TEST(KneeExamWatch, APivotShiftIsBentUnderItsLoad) {
  ExamWatchRig rig;
  // Loaded too late.
  for (const double deg : {20.0, 30.0, 40.0}) EXPECT_TRUE(rig.see(deg, 0, 1).empty());
  rig.see(10, 0, 0);
  // The load went off on the way.
  EXPECT_TRUE(rig.see(10, 0, 1).empty());
  EXPECT_TRUE(rig.see(25, 0, 0.5).empty());
  EXPECT_TRUE(rig.see(45, 0, 1).empty());
  rig.see(5, 0, 0);
  for (const double deg : {5.0, 20.0, 29.0}) EXPECT_TRUE(rig.see(deg, 0, 1).empty());
  const auto told = rig.see(31, 0, 1);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].values[0], 1);
  ASSERT_TRUE(rig.found(KneeTest::kPivot));
  EXPECT_EQ(rig.found(KneeTest::kPivot)->flexion_deg, 5);  // where it stood farthest ahead
  EXPECT_TRUE(rig.see(50, 0, 1).empty());
}

TEST(KneeExamWatch, TheKneeWithAGraftIsAnother) {
  ExamWatchRig rig;
  rig.see(30, 1, 0);
  rig.see(30, 0, 0);
  rig.bones.exam.knee = 1;
  const auto told = rig.see(30, 1, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].values[1], 1);
  EXPECT_TRUE(rig.watch.exam().found[0][0]);
  EXPECT_TRUE(rig.watch.exam().found[1][0]);
  // A restore point ends what was begun.
  rig.bones.exam.knee = 0;
  rig.see(5, 0, 1);
  ++rig.bones.epoch;
  rig.see(30, 0, 1);
  EXPECT_TRUE(rig.see(45, 0, 1).empty());
}

}  // namespace
}  // namespace osteon
