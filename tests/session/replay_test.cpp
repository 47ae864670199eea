#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "osteon/base/latest_value.h"
#include "osteon/base/random.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::command_at;
using testing::hand_at;
using testing::moving_bones;
using testing::record_one_thread;
using testing::two_box_case;

constexpr std::uint64_t kTicks = 3000;

void expect_identical(const Result<ReplayOutcome>& outcome) {
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << "tick " << outcome->first_different_tick;
}

TEST(Replay, OfNothingIsIdentical) {
  const auto the_case = two_box_case();
  Recording recording;
  recording.header = recording_header(*the_case, {}, "test", "0");
  const auto outcome = replay(recording, the_case);
  expect_identical(outcome);
  EXPECT_EQ(outcome->ticks, 0u);
}

TEST(Replay, RepeatsASessionInOneThread) {
  const auto the_case = two_box_case();
  std::uint64_t final_hash = 0;
  const Recording recording = record_one_thread(the_case, moving_bones(), kTicks, &final_hash);
  std::uint64_t seen = 0;
  bool bones_fit = true;
  const auto outcome =
      replay(recording, the_case, [&](const ToolState& tool, const BoneSnapshot& bones) {
        EXPECT_EQ(tool.tick, ++seen);
        bones_fit = bones_fit && bones.step == recording.ticks[tool.tick - 1].bone_step;
      });
  expect_identical(outcome);
  EXPECT_TRUE(bones_fit);
  EXPECT_EQ(seen, kTicks);
  EXPECT_EQ(outcome->ticks, kTicks);
  const Report& report = outcome->report;
  EXPECT_EQ(report.state_hash, final_hash);
  // In the test's XML: equal in every build of one version.
  RecordProperty("state_hash", std::to_string(final_hash));
  EXPECT_EQ(report.ticks, kTicks);
  EXPECT_NEAR(report.duration_s, 3, 1e-9);
  for (const BoneReport& bone : report.bones) {
    EXPECT_GT(bone.contact_time_s, 0.1) << bone.name;
    EXPECT_GT(bone.peak_force_n, 0.5) << bone.name;
  }
  EXPECT_GT(report.path_length_mm, 30);
  EXPECT_LT(report.smoothness_sparc, 0);
  EXPECT_GT(report.tick_p50_us, 0);
  EXPECT_GE(report.tick_max_us, report.tick_p50_us);
  EXPECT_GT(report.step_p50_us, 0);
  EXPECT_GE(report.step_max_us, report.step_p50_us);
  EXPECT_GT(report.realtime_factor, 0);
}

TEST(Replay, RepeatsWithOtherSteps) {
  const auto the_case = two_box_case();
  for (const double step_s : {0.001, 0.003, 0.01}) {
    SessionSettings settings = moving_bones();
    settings.physics.step_s = step_s;
    expect_identical(replay(record_one_thread(the_case, settings, 1000), the_case));
  }
}

// Two clocks in one thread: which of them runs next is drawn, and each takes the newest of what the
// other has published, which it may see late.
Recording record_two_clocks(const std::shared_ptr<const Case>& the_case, std::uint64_t seed,
                            std::uint64_t ticks, std::uint64_t* final_hash) {
  Session session(the_case, moving_bones());
  Recording recording;
  recording.header = recording_header(*the_case, moving_bones(), "test", "0");
  LatestValue<ToolState> tools;
  LatestValue<BoneSnapshot> bones(session.bones());
  // What each side took last; it keeps that until it looks again.
  ToolState tool_seen;
  BoneSnapshot bones_seen = session.bones();
  Random random(seed);
  const double haptic_share = random.uniform(0.2, 0.9);
  while (recording.ticks.size() < ticks) {
    const bool looks = random.uniform() < 0.8;
    if (random.uniform() < haptic_share) {
      const std::uint64_t n = recording.ticks.size() + 1;
      if (looks) bones_seen = bones.read();
      tools.publish(session.haptic_tick(hand_at(n), bones_seen, command_at(n)));
      recording.ticks.push_back(session.last_tick_record());
    } else {
      const std::uint64_t n = recording.steps.size() + 1;
      if (looks) tool_seen = tools.read();
      bones.publish(session.physics_step(tool_seen, command_at(n)));
      recording.steps.push_back(session.last_step_record());
    }
  }
  *final_hash = session.state_hash();
  return recording;
}

TEST(Replay, RepeatsTwoClocksHoweverTheyInterleave) {
  const auto the_case = two_box_case();
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::uint64_t final_hash = 0;
    const Recording recording = record_two_clocks(the_case, seed, 2000, &final_hash);
    const auto outcome = replay(recording, the_case);
    expect_identical(outcome);
    EXPECT_EQ(outcome->report.state_hash, final_hash) << seed;
  }
}

TEST(Replay, GoesThroughAFile) {
  const auto the_case = two_box_case();
  const Recording recording = record_one_thread(the_case, moving_bones(), 1500);
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     ("osteon_replay_" + std::to_string(getpid()) + ".osr");
  std::filesystem::remove(file);
  {
    auto writer = RecordingWriter::create(file, recording.header);
    ASSERT_TRUE(writer) << writer.error().message();
    std::size_t step = 0;
    for (const TickRecord& tick : recording.ticks) {
      for (; step < tick.bone_step; ++step) ASSERT_TRUE(writer->add(recording.steps[step]));
      ASSERT_TRUE(writer->add(tick));
    }
    for (; step < recording.steps.size(); ++step) ASSERT_TRUE(writer->add(recording.steps[step]));
    ASSERT_TRUE(writer->finish());
  }
  const auto loaded = load_recording(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(loaded) << loaded.error().message();
  ASSERT_EQ(loaded->ticks.size(), 1500u);
  ASSERT_EQ(loaded->steps.size(), recording.steps.size());
  expect_identical(replay(*loaded, the_case));
}

TEST(Replay, NamesTheFirstDifferentTick) {
  const auto the_case = two_box_case();
  const Recording sound = record_one_thread(the_case, moving_bones(), 1000);
  const auto first_different = [&](auto change) -> std::uint64_t {
    Recording changed = sound;
    change(changed);
    const auto outcome = replay(changed, the_case);
    EXPECT_TRUE(outcome) << outcome.error().message();
    EXPECT_FALSE(outcome->identical);
    EXPECT_EQ(outcome->ticks, 1000u);
    return outcome->first_different_tick;
  };
  // An input in contact changes the force of that very tick.
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[321].input.X_WD.p.z() -= 1e-6; }), 322u);
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[555].force_W.x() += 1e-12; }), 556u);
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[556].p_WP.x() += 1e-12; }), 557u);
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[557].status ^= kTickForceClamped; }), 558u);
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[699].state_hash ^= 1; }), 700u);
  EXPECT_EQ(first_different([](Recording& r) { r.ticks[400].command = {}; }), 401u);
  // A hold that did not happen is felt when the next snapshot comes.
  const std::uint64_t held = first_different([](Recording& r) {
    for (StepRecord& step : r.steps)
      if (step.command.kind == CommandKind::kHoldBones) step.command = {};
  });
  EXPECT_GE(held, 778u);
  EXPECT_LE(held, 800u);
}

TEST(Replay, WithOtherSettingsDiffers) {
  const auto the_case = two_box_case();
  Recording recording = record_one_thread(the_case, moving_bones(), 500);
  SessionSettings other = moving_bones();
  other.haptic.damping_n_s_per_m *= 1.5;
  recording.header.settings_json = to_json(other);
  const auto outcome = replay(recording, the_case);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->identical);
}

TEST(Replay, RefusesAnotherCase) {
  const auto the_case = two_box_case();
  const Recording recording = record_one_thread(the_case, moving_bones(), 10);
  const auto outcome = replay(recording, two_box_case(0.005));
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message().find("another case"), std::string::npos);
}

TEST(Replay, RefusesAHeaderThatDoesNotFit) {
  const auto the_case = two_box_case();
  Recording recording = record_one_thread(the_case, moving_bones(), 10);
  recording.header.seed = 43;
  EXPECT_FALSE(replay(recording, the_case));
  recording.header.seed = 42;
  recording.header.settings_json = "{}";
  EXPECT_FALSE(replay(recording, the_case));
}

TEST(Replay, RefusesWhatCannotBeRepeated) {
  const auto the_case = two_box_case();
  Recording recording = record_one_thread(the_case, moving_bones(), 100);
  recording.ticks[50].bone_step = 51;
  EXPECT_FALSE(replay(recording, the_case));
}

TEST(Replay, RefusesClocksThatRunTooFarApart) {
  // Physics that took every tick's tool but was never seen by a tick: nothing that threads do, and
  // it would fill the memory.
  const auto the_case = two_box_case();
  Recording recording;
  recording.header = recording_header(*the_case, moving_bones(), "test", "0");
  for (std::uint64_t n = 1; n <= 21000; ++n) {
    TickRecord tick;
    tick.tick = n;
    tick.input.X_WD.p = {0, 0, 0.1};
    recording.ticks.push_back(tick);
    recording.steps.push_back({n, {n}, {}});
  }
  const auto outcome = replay(recording, the_case);
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message().find("apart"), std::string::npos);
}

}  // namespace
}  // namespace osteon
