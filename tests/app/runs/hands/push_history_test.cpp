#include "runs/hands/push_history.h"

#include <gtest/gtest.h>

#include "osteon/physics/skin_state.h"

namespace osteon {
namespace {

SoftPushes pushed(double force_n) {
  SoftPushes pushes;
  pushes.count = 1;
  pushes.all[0].force_n = force_n;
  return pushes;
}

// Nothing for a second, a push that grows until 2 s and stays until 3 s, then nothing.
PushHistory one_push() {
  PushHistory history;
  for (int tick = 1; tick <= 4000; ++tick) {
    const double t = tick * 0.001;
    if (t <= 1 || t > 3)
      history.add({}, t);
    else
      history.add(pushed(std::min(t - 1, 1.0)), t);
  }
  return history;
}

TEST(PushHistory, GivesWhatPressedAtATimeInAnyOrder) {
  const PushHistory history = one_push();
  EXPECT_EQ(history.at(3.5).count, 0u);
  EXPECT_EQ(history.at(2.5), pushed(1));
  EXPECT_EQ(history.at(0.5).count, 0u);
  ASSERT_EQ(history.at(1.5).count, 1u);
  EXPECT_NEAR(history.at(1.5).all[0].force_n, 0.5, 0.02);
}

TEST(PushHistory, KeepsWhatChangesAtThePicturesRate) {
  EXPECT_LE(one_push().kept(), static_cast<std::size_t>(PushHistory::kPictureHz) + 3);
  EXPECT_EQ(PushHistory().at(1).count, 0u);
}

TEST(PushHistory, KeepsHowLigamentsBendToo) {
  PushHistory history;
  SoftPushes bent;
  bent.bend_count = 1;
  bent.bends[0].bent_m = 0.002;
  for (int tick = 1; tick <= 300; ++tick)
    history.add(tick <= 100 || tick > 200 ? SoftPushes{} : bent, tick * 0.001);
  EXPECT_EQ(history.at(0.05), SoftPushes{});
  EXPECT_EQ(history.at(0.19), bent);
  EXPECT_EQ(history.at(0.29), SoftPushes{});
  EXPECT_EQ(history.kept(), 2u);
}

TEST(PushHistory, KeepsWhereLipsAreHeldApart) {
  PushHistory history;
  SoftPushes held;
  held.lip_count = 1;
  held.lip_pulls[0].force_n = 2;
  for (int tick = 1; tick <= 300; ++tick)
    history.add(tick <= 100 || tick > 200 ? SoftPushes{} : held, tick * 0.001);
  EXPECT_EQ(history.at(0.19), held);
  EXPECT_EQ(history.at(0.29), SoftPushes{});
}

TEST(PushHistory, KeepsWhichLigamentsAreInTwo) {
  PushHistory history;
  SoftPushes cut;
  cut.break_count = 1;
  cut.breaks[0] = {2, 0.3};
  for (int tick = 1; tick <= 300; ++tick)
    history.add(tick <= 100 ? SoftPushes{} : cut, tick * 0.001);
  EXPECT_EQ(history.at(0.05), SoftPushes{});
  EXPECT_EQ(history.at(0.29), cut);
  EXPECT_EQ(history.kept(), 1u);
}

TEST(PushHistory, KeepsDentsAndCutsOfSkin) {
  PushHistory history;
  SoftPushes pressed;
  pressed.skin_count = 1;
  pressed.skin_dents[0] = {1, {0.002, 0.003}, 0.004};
  SoftPushes cut;
  cut.skin_cuts[1] = std::make_shared<const SkinCuts>();
  for (int tick = 1; tick <= 300; ++tick)
    history.add(tick <= 100 ? SoftPushes{} : tick <= 200 ? pressed : cut, tick * 0.001);
  EXPECT_EQ(history.at(0.05), SoftPushes{});
  EXPECT_EQ(history.at(0.19), pressed);
  EXPECT_EQ(history.at(0.29), cut);
  EXPECT_EQ(history.kept(), 2u);
}

TEST(PushHistory, KeepsWhatOfALigamentIsCutAndWhatLoadsIt) {
  PushHistory history;
  SoftPushes cut;
  cut.notch_count = 1;
  cut.notches[0] = {1, 0.4, 0b101};
  SoftPushes loaded = cut;
  loaded.load_count = 1;
  loaded.loads[0] = {3, {2.5}, 30, 0.9};
  for (int tick = 1; tick <= 300; ++tick)
    history.add(tick <= 100 ? SoftPushes{} : tick <= 200 ? cut : loaded, tick * 0.001);
  EXPECT_EQ(history.at(0.05), SoftPushes{});
  EXPECT_EQ(history.at(0.19), cut);
  EXPECT_EQ(history.at(0.29), loaded);
}

}  // namespace
}  // namespace osteon
