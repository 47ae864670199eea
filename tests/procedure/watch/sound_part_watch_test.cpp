#include "osteon/procedure/sound_part_watch.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

constexpr std::uint32_t kPcl = 0, kFat = 1, kShaver = 1;

// A knee of two soft parts, and one hand whose tip is in one of them.
struct SoundPartRig {
  SoundPartRig() {
    the_case.softs.resize(2);
    the_case.softs[kPcl].kind = "ligament";
    the_case.softs[kFat].kind = "fat";
    tool.instrument = kShaver;
    tool.power = 1;
    put_in(kPcl, 0.002);
  }
  void put_in(std::uint32_t part, double deep_m) {
    bones.inside[0][0] = {SubjectKind::kSoftPart, part, bones.step + 1, bones.step + 1, deep_m};
  }
  // Two ticks a step; the tip stays in.
  std::vector<Event> run(int ticks) {
    std::vector<Event> out;
    const ToolState* const tools[] = {&tool};
    for (int i = 0; i < ticks; ++i) {
      ++tool.tick;
      if (tool.tick % 2 == 0) ++bones.step;
      if (stays) bones.inside[0][0].last_step = bones.step;
      watch.add(tools, bones, out);
    }
    return out;
  }
  Case the_case;
  ToolState tool;
  BoneSnapshot bones;
  bool stays = true;
  SoundPartWatch watch{the_case, {0, 1}, 0.001};
};

TEST(SoundPartWatch, TellsHowLongATipThatClearsWasInALigament) {
  SoundPartRig rig;
  const auto told = rig.run(120);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].kind, kSoundPartCleared);
  EXPECT_EQ(told[0].subject, kPcl);
  EXPECT_NEAR(told[0].values[0], 0.05, 1e-12);
  EXPECT_NEAR(told[1].values[0], 0.1, 1e-12);
  EXPECT_NEAR(told[1].values[1], 2, 1e-12);
  EXPECT_EQ(told[1].tick, 100u);
  // The next visit begins anew.
  rig.put_in(kPcl, 0.001);
  const auto again = rig.run(60);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_NEAR(again[0].values[0], 0.05, 1e-12);
}

TEST(SoundPartWatch, SaysNothingOfWhatDoesNotRunDoesNotClearOrIsNotIn) {
  SoundPartRig still;
  still.tool.power = 0;
  EXPECT_TRUE(still.run(200).empty());
  SoundPartRig hook;
  hook.tool.instrument = 0;
  EXPECT_TRUE(hook.run(200).empty());
  SoundPartRig stranger;
  stranger.tool.instrument = 7;
  EXPECT_TRUE(stranger.run(200).empty());
  SoundPartRig fat;
  fat.put_in(kFat, 0.003);
  EXPECT_TRUE(fat.run(200).empty());
  SoundPartRig left;
  left.stays = false;
  EXPECT_TRUE(left.run(200).empty());
  SoundPartRig bone;
  bone.bones.inside[0][0].kind = SubjectKind::kBone;
  EXPECT_TRUE(bone.run(200).empty());
  SoundPartRig nowhere;
  nowhere.bones.inside[0][0].subject = 9;
  EXPECT_TRUE(nowhere.run(200).empty());
}

TEST(SoundPartWatch, TellsWhatFeltPartsHaveLostByWholeNumbersAndAgainAfterARestorePoint) {
  SoundPartRig rig;
  rig.stays = false;
  const auto lose = [&](std::uint32_t part, double mm3, double percent) {
    rig.bones.softs.loss_count = 1;
    rig.bones.softs.losses[0] = {part, mm3, percent};
    return rig.run(3);
  };
  EXPECT_TRUE(lose(kPcl, 0, 0.9).empty());
  const auto told = lose(kPcl, 0, 3.3);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kSoundPartLost);
  EXPECT_EQ(told[0].subject_kind, SubjectKind::kSoftPart);
  EXPECT_EQ(told[0].subject, kPcl);
  EXPECT_EQ(told[0].values, (std::array<double, 3>{0, 3.3, 0}));
  EXPECT_TRUE(lose(kPcl, 0, 3.9).empty());
  const auto more = lose(kPcl, 0, 6.6);
  ASSERT_EQ(more.size(), 1u);
  EXPECT_EQ(more[0].values[2], 3);
  EXPECT_TRUE(lose(kFat, 40, 0).empty()) << "no sound part";
  EXPECT_TRUE(lose(9, 40, 0).empty()) << "no part";
  const auto again = lose(kPcl, 0, 2);
  ASSERT_EQ(again.size(), 1u) << "it was whole meanwhile";
  EXPECT_EQ(again[0].values[2], 0);
}

}  // namespace
}  // namespace osteon
