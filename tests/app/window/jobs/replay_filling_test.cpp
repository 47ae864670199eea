#include "window/jobs/replay_filling.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "session/two_hands.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using testing::record_hands;
using testing::two_box_case;

constexpr std::uint64_t kFillingTicks = 7000;

void write_recording(const fs::path& file, const Recording& recording) {
  auto writer = RecordingWriter::create(file, recording.header).value();
  std::size_t step = 0;
  for (std::size_t n = 0; n < recording.ticks.size(); ++n) {
    const std::uint64_t consumed =
        std::max(recording.ticks[n].bone_step, recording.more_hands[0][n].bone_step);
    for (; step < consumed; ++step) ASSERT_TRUE(writer.add(recording.steps[step]));
    for (std::size_t h = 0; h < 2; ++h) ASSERT_TRUE(writer.add(recording.ticks_of(h)[n], h));
  }
  for (; step < recording.steps.size(); ++step) ASSERT_TRUE(writer.add(recording.steps[step]));
  for (const Event& event : recording.events) ASSERT_TRUE(writer.add(event));
  for (const StoredState& state : recording.states) ASSERT_TRUE(writer.add(state));
  ASSERT_TRUE(writer.finish());
}

// Seven seconds of two hands, a state every second.
struct FilledReplay : ::testing::Test {
  void SetUp() override {
    recording = record_hands(the_case, 5, kFillingTicks, nullptr, 1000);
    fs::remove(file);
    write_recording(file, recording);
  }
  void repeat_from_the_start() {
    ReplayOptions how;
    how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                      std::span<const Event>) { whole[hand].add(tool, bones); };
    ASSERT_TRUE(replay(recording, the_case, how)->identical);
  }
  void TearDown() override { fs::remove(file); }
  void expect_as_the_whole(double time_s) const {
    for (std::size_t h = 0; h < 2; ++h) {
      const ToolState is = (h == 0 ? replay_of.track : replay_of.more[0]).at(time_s).tool;
      const ToolState wanted = whole[h].at(time_s).tool;
      // Pictures are taken at other ticks of the same run.
      EXPECT_LT((is.X_WP.p - wanted.X_WP.p).norm(), 5e-4) << h << " " << time_s;
      EXPECT_NEAR(is.time_s, wanted.time_s, 0.02) << h;
    }
  }
  void finish(ReplayFilling& filling, double at_s) {
    for (int i = 0; i < 100 && !filling.whole(); ++i) {
      const auto polled = filling.poll(at_s, replay_of);
      ASSERT_TRUE(polled) << polled.error().message();
      filling.wait();
    }
  }

  std::shared_ptr<const Case> the_case = two_box_case();
  fs::path file =
      fs::path(::testing::TempDir()) / ("osteon_filling_" + std::to_string(::getpid()) + ".osr");
  Recording recording;
  std::array<ReplayTrack, 2> whole;  ///< repeated from the start
  LoadedReplay replay_of;
};

// The moment that is looked at comes first, without what lies before it; then the rest, and all of
// it is what a repetition from the start gives.
TEST_F(FilledReplay, BeginsWhereTheUserLooksAndEndsWhole) {
  repeat_from_the_start();
  auto planned = ReplayFilling::plan(file, the_case, {});
  ASSERT_TRUE(planned) << planned.error().message();
  ASSERT_TRUE(*planned);
  ReplayFilling& filling = **planned;
  EXPECT_DOUBLE_EQ(filling.duration_s(), 7);
  ASSERT_TRUE(filling.fill_at(5.3, replay_of, {}));
  expect_as_the_whole(5.3);
  EXPECT_LT(replay_of.ticks, 3500u);
  EXPECT_GT(replay_of.track.at(0).tool.time_s, 3.9);  // nothing before is there yet
  EXPECT_FALSE(filling.whole());
  EXPECT_FALSE(replay_of.events.events().empty());

  finish(filling, 1.2);
  EXPECT_TRUE(replay_of.identical);
  EXPECT_EQ(replay_of.ticks, kFillingTicks);
  EXPECT_NEAR(replay_of.track.duration_s(), 7, 0.002);
  for (double t = 0.1; t < 6.9; t += 0.083) expect_as_the_whole(t);
  EXPECT_EQ(replay_of.track.force_until(7, 1750), whole[0].force_until(7, 1750));
  const auto spans = replay_of.track.contacts().spans();
  ASSERT_EQ(spans.size(), whole[0].contacts().spans().size());
  for (const ContactSpan& span : whole[0].contacts().spans())
    EXPECT_TRUE(std::any_of(spans.begin(), spans.end(), [&](const ContactSpan& s) {
      return s.bone == span.bone && s.start_s == span.start_s && s.end_s == span.end_s &&
             s.peak_force_n == span.peak_force_n;
    })) << span.start_s;
}

TEST_F(FilledReplay, ADifferenceIsNamedWhateverTheOrder) {
  recording.ticks[2320].force_W.x() += 1e-9;
  fs::remove(file);
  write_recording(file, recording);
  auto planned = ReplayFilling::plan(file, the_case, {});
  ASSERT_TRUE(planned && *planned);
  ASSERT_TRUE((*planned)->fill_at(5.3, replay_of, {}));
  EXPECT_TRUE(replay_of.identical);
  finish(**planned, 5.3);
  EXPECT_FALSE(replay_of.identical);
  EXPECT_EQ(replay_of.first_different_tick, 2321u);
}

TEST_F(FilledReplay, WithoutStoredStatesItIsRepeatedWhole) {
  recording.states.clear();
  fs::remove(file);
  write_recording(file, recording);
  const auto planned = ReplayFilling::plan(file, the_case, {});
  ASSERT_TRUE(planned);
  EXPECT_FALSE(*planned);
  EXPECT_FALSE(ReplayFilling::plan("/nowhere/run.osr", the_case, {}));
}

TEST_F(FilledReplay, AFileThatIsGoneIsAnErrorOnce) {
  auto planned = ReplayFilling::plan(file, the_case, {});
  ASSERT_TRUE(planned && *planned);
  fs::remove(file);
  EXPECT_FALSE((*planned)->fill_at(3, replay_of, {}));
  int errors = 0;
  for (int i = 0; i < 20; ++i) {
    errors += !(*planned)->poll(3, replay_of);
    (*planned)->wait();
  }
  EXPECT_EQ(errors, 1);
}

}  // namespace
}  // namespace osteon
