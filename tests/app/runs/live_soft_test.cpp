// A live run with a part that gives way: what presses it reaches who draws, and its recording says
// the same.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "osteon/physics/soft_shape.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"
#include "runs/hands/live_run.h"
#include "runs/hands/push_history.h"
#include "session/soft_solid_fixtures.h"

namespace osteon {
namespace {

// Down onto the block within half a second, 2 mm deep, and there it rests.
ProbePath onto_the_block() {
  ProbePath path;
  for (const auto& [time_s, z] : {std::pair{0.0, 0.004}, {0.5, -0.002}, {60.0, -0.002}}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(0, 0, testing::kBlockTop_m + z);
    path.samples.push_back(sample);
  }
  return path;
}

LiveRun pressing_run() {
  const testing::MeniscusRun& with = testing::meniscus_run();
  RunTray tray;
  tray.names = {"ball"};
  tray.tools = with.tray;
  tray.softs = {with.settings.soft, with.softs};
  return LiveRun(with.the_case, "block", onto_the_block(), {}, std::move(tray));
}

Result<void> begin(LiveRun& live) {
  const auto choices = list_device_choices(nullptr);
  return live.start(choices.at(static_cast<std::size_t>(find_choice(choices, "virtual"))), Pose{});
}

// The loops run in real time; how long they take does not matter.
bool is_pressed_within_10_s(LiveRun& live, double force_n) {
  for (int n = 0; n < 10000; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    live.update();
    if (live.pushes().count > 0 && live.pushes().all[0].force_n > force_n) return true;
  }
  return false;
}

TEST(LiveSoft, WhatPressesReachesThePicture) {
  LiveRun live = pressing_run();
  ASSERT_TRUE(begin(live));
  EXPECT_EQ(live.pushes().count, 0u);
  ASSERT_TRUE(is_pressed_within_10_s(live, 0.5));
  // 2 mm of 900 N/m and the hand's own spring.
  EXPECT_LT(live.pushes().all[0].force_n, 0.002 * testing::kMeniscus_n_per_m);
  EXPECT_GT(live.pushes().all[0].nhat_B.z(), 0.9);
  SoftShapes shapes(*testing::meniscus_run().the_case, live.softs());
  ASSERT_EQ(shapes.changes(live.pushes()).size(), 1u);
  // A new run begins with nothing pressed.
  ASSERT_TRUE(live.exchange_case(testing::meniscus_run().the_case, "block", onto_the_block()));
  EXPECT_EQ(live.softs(), nullptr);
  live.update();
  EXPECT_EQ(live.pushes().count, 0u);
}

TEST(LiveSoft, ItsRecordingRepeatsWithTheSamePushes) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     ("live_soft_" + std::to_string(::getpid()) + ".osr");
  const testing::MeniscusRun& with = testing::meniscus_run();
  LiveRun live = pressing_run();
  ASSERT_TRUE(begin(live));
  ASSERT_TRUE(live.start_recording(file));
  ASSERT_TRUE(is_pressed_within_10_s(live, 0.5));
  ASSERT_TRUE(live.stop_recording());
  const auto recording = load_recording(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(recording) << recording.error().message();
  const auto settings = parse_settings(recording->header.settings_json);
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->soft, with.settings.soft);
  EXPECT_EQ(settings->soft_hash, with.softs->hash);
  PushHistory history;
  SoftPushes now;
  double end_s = 0;
  ReplayOptions options;
  options.tray = with.tray;
  options.softs = with.softs;
  options.on_pushes = [&](const SoftPushes& pushes) { now = pushes; };
  options.on_tick = [&](std::size_t, const ToolState& tool, const BoneSnapshot&,
                        std::span<const Event>) { history.add(now, end_s = tool.time_s); };
  const auto outcome = replay(*recording, with.the_case, options);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical);
  ASSERT_EQ(history.at(end_s).count, 1u);
  EXPECT_GT(history.at(end_s).all[0].force_n, 0.4);
}

}  // namespace
}  // namespace osteon
