#include "runs/hands/live_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "../../../session/drilling.h"
#include "../../loops/fake_device.h"
#include "osteon/base/file.h"
#include "osteon/record/recording.h"
#include "runs/hands/begun_run.h"

namespace osteon {
namespace {

// Far from the blocks; after a second it leaps by 0.2 m, faster than any hand may move.
ProbePath leaping_path() {
  ProbePath path;
  for (const auto& [time_s, x] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.01, 0.2}, {9.0, 0.2}}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(x, 0, 0.1);
    path.samples.push_back(sample);
  }
  return path;
}

DeviceChoice virtual_hand() {
  const auto choices = list_device_choices(nullptr);
  return choices.at(static_cast<std::size_t>(find_choice(choices, "virtual")));
}

// The loops run in real time; how long they take does not matter.
template <class Until>
void run_until(LiveRun& live, Until until) {
  do {
    std::this_thread::yield();
    live.update();
  } while (!until());
}

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() : live(test::blocks_case(), "blocks", leaping_path(), {}) {
    EXPECT_TRUE(live.start(virtual_hand(), Pose{}));
  }
  ~LiveRunTest() override {
    std::filesystem::remove(file);
    std::filesystem::remove(log);
  }

  // A machine that stands still for a while takes the force away too: it is taken up again. False:
  // it stood still in the leap itself.
  bool it_trips() {
    const auto cause = [&] { return live.device_status().cause; };
    run_until(live, [&] {
      if (cause() == ForceOff::kWatchdog) live.resume();
      return cause() == ForceOff::kVelocity || live.snapshot().tool.tick > 3000;
    });
    return cause() == ForceOff::kVelocity;
  }
  // The first that the new run tells.
  ForceOff cause_of_next_run() {
    run_until(live, [&] { return live.snapshot().tool.tick < 900; });
    return live.device_status().cause;
  }

  LiveRun live;
  std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / ("live_" + std::to_string(::getpid()) + ".osr");
  std::filesystem::path log =
      std::filesystem::path(::testing::TempDir()) / ("live_" + std::to_string(::getpid()) + ".csv");
};

TEST_F(LiveRunTest, ARecordingThatBeginsAfterATripDoesNotArmTheForceAgain) {
  if (!it_trips()) GTEST_SKIP() << "the machine stood still";
  ASSERT_TRUE(live.start_recording(file));
  EXPECT_EQ(cause_of_next_run(), ForceOff::kVelocity);
  live.set_force(true);
  run_until(live, [&] { return live.device_status().cause == ForceOff::kNone; });
  EXPECT_TRUE(live.stop_recording());
}

TEST_F(LiveRunTest, AFaultIsResumedForTheActiveHandAlone) {
  const std::vector<LiveHandOrder> both = {{virtual_hand(), "left"}, {virtual_hand(), "right"}};
  ASSERT_TRUE(live.start(both, {Pose{}, Pose{}}));
  const auto cause = [&](std::size_t hand) { return live.hand(hand).status.cause; };
  const auto tick = [&](std::size_t hand) { return live.hand(hand).snapshot.tool.tick; };
  // The leap is over: nothing trips a second time.
  run_until(live, [&] { return tick(0) > 1200 && tick(1) > 1200; });
  if (cause(0) != ForceOff::kVelocity || cause(1) != ForceOff::kVelocity)
    GTEST_SKIP() << "the machine stood still";
  live.resume();
  // A machine that stands still now takes the force of the first hand away again.
  run_until(live, [&] {
    if (cause(0) == ForceOff::kWatchdog) live.resume();
    return cause(0) == ForceOff::kNone;
  });
  EXPECT_EQ(cause(1), ForceOff::kVelocity);
  live.set_force(false);
  live.resume();
  run_until(live, [&] { return cause(1) == ForceOff::kNone; });
}

// The mouse's hand is where the run began until it is moved: a run that follows at once is there
// too.
TEST_F(LiveRunTest, ARunThatFollowsAtOnceBeginsWhereTheOneBeforeDid) {
  const auto choices = list_device_choices(nullptr);
  const Pose start{Vec3(0.01, -0.02, 0.2), Quat::Identity()};
  LiveRun mouse(test::blocks_case(), "blocks", leaping_path(), {});
  ASSERT_TRUE(
      mouse.start(choices.at(static_cast<std::size_t>(find_choice(choices, "mouse"))), start));
  ASSERT_TRUE(mouse.start_recording(file));
  run_until(mouse, [&] { return mouse.snapshot().tool.tick > 4; });
  EXPECT_LT((mouse.snapshot().tool.X_WP.p - start.p).norm(), 1e-6);
}

TEST_F(LiveRunTest, EndedItKeepsTheRecordingAndRunsNoMore) {
  live.keep_force_log(log);
  ASSERT_TRUE(live.start_recording(file));
  run_until(live, [&] { return live.snapshot().tool.tick > 100; });
  ASSERT_TRUE(live.end());
  EXPECT_FALSE(live.recording());
  const auto recording = load_recording(file);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_TRUE(recording->complete);
  EXPECT_GT(recording->ticks.size(), 100u);
  // The device was closed once, and none was opened after it.
  const std::string told = read_file(log).value();
  EXPECT_GT(told.size(), 1000u);
  EXPECT_TRUE(told.ends_with("closed\n"));
  EXPECT_TRUE(live.end());
  live.update();
}

TEST_F(LiveRunTest, ALentDeviceComesBackToARunThatIsAsItWas) {
  EXPECT_TRUE(live.lend_device());
  EXPECT_FALSE(live.lend_device());
  EXPECT_FALSE(live.start_recording(file));
  live.update();  // stands still, harmlessly
  live.set_force(false);
  ASSERT_TRUE(live.take_back(nullptr));
  run_until(live, [&] { return live.snapshot().tool.tick > 8; });
  EXPECT_EQ(live.device_status().cause, ForceOff::kSoftware);
  live.set_force(true);
  if (!it_trips()) GTEST_SKIP() << "the machine stood still";
  ASSERT_TRUE(live.take_back(live.lend_device()));
  EXPECT_EQ(cause_of_next_run(), ForceOff::kVelocity);
}

// Felt as before, but one bone is farther away: what is told afterwards comes from the new case.
TEST_F(LiveRunTest, ACaseIsExchangedWhereTheProbeIsAndNotWhileRecording) {
  const auto finer = std::make_shared<Case>(*test::blocks_case());
  finer->bones[0].X_WB.p.x() += 0.5;
  const Pose start{Vec3(0.01, -0.02, 0.2), Quat::Identity()};
  LiveRun mouse(test::blocks_case(), "blocks#hull", leaping_path(), {});
  ASSERT_TRUE(mouse.exchange_case(test::blocks_case(), "blocks#hull", leaping_path()))
      << "before anything runs";
  const auto choices = list_device_choices(nullptr);
  ASSERT_TRUE(
      mouse.start(choices.at(static_cast<std::size_t>(find_choice(choices, "mouse"))), start));
  run_until(mouse, [&] { return mouse.snapshot().tool.tick > 4; });
  EXPECT_TRUE(mouse.touches_nothing());
  ASSERT_TRUE(mouse.start_recording(file));
  EXPECT_FALSE(mouse.exchange_case(finer, "blocks", leaping_path()));
  ASSERT_TRUE(mouse.stop_recording());
  ASSERT_TRUE(mouse.exchange_case(finer, "blocks", leaping_path()));
  run_until(mouse, [&] {
    return mouse.snapshot().tool.tick > 4 && mouse.snapshot().bones.bones[0].X_WB.p.x() > 0.4;
  });
  EXPECT_LT((mouse.snapshot().tool.X_WP.p - start.p).norm(), 1e-6);
  const auto recording = load_recording(file);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ(recording->header.case_source, "blocks#hull") << "names what was felt then";
}

DeviceChoice choice_named(const char* driver) {
  const auto choices = list_device_choices(nullptr);
  return choices.at(static_cast<std::size_t>(find_choice(choices, driver)));
}

TEST(LiveHands, ASecondHandByMouseComesInAndTheFirstStaysWhereItWas) {
  const Pose right{Vec3(0.01, -0.02, 0.2), Quat::Identity()};
  const Pose left{Vec3(-0.03, -0.02, 0.2), Quat::Identity()};
  LiveRun live(test::blocks_case(), "blocks", leaping_path(), {});
  ASSERT_TRUE(live.start(choice_named("mouse"), right));
  EXPECT_FALSE(live.change_hands());
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  ASSERT_TRUE(live.add_hand(left, 0));
  ASSERT_EQ(live.hands(), 2u);
  EXPECT_EQ(live.active(), 1u);
  run_until(live, [&] { return live.snapshot().tool.tick > 4 && !live.others().empty(); });
  EXPECT_LT((live.snapshot().tool.X_WP.p - left.p).norm(), 1e-6);
  EXPECT_LT((live.others()[0].X_WP.p - right.p).norm(), 1e-6);
  ASSERT_TRUE(live.change_hands());
  EXPECT_EQ(live.active(), 0u);
  EXPECT_TRUE(live.rests(1));
  // One millimetre inwards along its shaft, which points along +z.
  live.nudge(1, 0.001, 0, 0, 0, Quat::Identity());
  run_until(live, [&] { return std::abs(live.others()[0].X_WP.p.z() - 0.199) < 1e-6; });
  EXPECT_LT((live.snapshot().tool.X_WP.p - right.p).norm(), 1e-6);
}

TEST(LiveHands, AGamepadMovesTheHandThatRestsWhileTheMouseMovesTheOther) {
  const Pose right{Vec3(0.01, -0.02, 0.2), Quat::Identity()};
  const Pose left{Vec3(-0.03, -0.02, 0.2), Quat::Identity()};
  LiveRun live(test::blocks_case(), "blocks", leaping_path(), {});
  ASSERT_TRUE(live.start(choice_named("mouse"), right));
  PadSticks sticks;
  sticks.axes_C.move_V = Vec3(0, 1, 0);
  live.move_pad(sticks, Camera{}, 0.05);  // one hand: no hand rests, nothing moves
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  EXPECT_LT((live.snapshot().tool.X_WP.p - right.p).norm(), 1e-6);
  ASSERT_TRUE(live.add_hand(left, 0));
  run_until(live, [&] { return live.snapshot().tool.tick > 4 && !live.others().empty(); });
  // 20 mm/s for 0.05 s is one millimetre in along its shaft, which points along +z.
  live.move_pad(sticks, Camera{}, 0.05);
  run_until(live, [&] { return std::abs(live.others()[0].X_WP.p.z() - 0.199) < 1e-6; });
  EXPECT_LT((live.snapshot().tool.X_WP.p - left.p).norm(), 1e-6);
}

TEST(LiveHands, AGamepadsSecondButtonHandsItsSticksToTheHandThatRests) {
  LiveRun live(test::blocks_case(), "blocks", leaping_path(), {});
  ASSERT_TRUE(live.start(choice_named("gamepad"), {Vec3(0.01, -0.02, 0.2), Quat::Identity()}));
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  ASSERT_TRUE(live.add_hand({Vec3(-0.03, -0.02, 0.2), Quat::Identity()}, 0));
  run_until(live, [&] { return live.snapshot().tool.tick > 4 && !live.others().empty(); });
  ASSERT_TRUE(live.rests(0));
  const Vec3 active = live.snapshot().tool.X_WP.p, rested = live.others()[0].X_WP.p;
  PadSticks sticks;
  sticks.axes_C.move_V = Vec3(0, 1, 0);
  sticks.for_rested = true;
  live.move_pad(sticks, Camera{}, 0.05);
  run_until(live,
            [&] { return std::abs(live.others()[0].X_WP.p.z() - rested.z() + 0.001) < 1e-6; });
  EXPECT_LT((live.snapshot().tool.X_WP.p - active).norm(), 1e-6);
  sticks.for_rested = false;  // now the stick is the active hand's
  live.move_pad(sticks, Camera{}, 0.05);
  run_until(live, [&] { return (live.snapshot().tool.X_WP.p - active).norm() > 0.001; });
  EXPECT_NEAR(live.others()[0].X_WP.p.z(), rested.z() - 0.001, 1e-6);
}

TEST(LiveHands, OneDeviceServesTwoHandsByTurns) {
  ProbePath still;
  for (const double time_s : {0.0, 100.0}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(0, 0, 0.1);
    still.samples.push_back(sample);
  }
  LiveRun live(test::blocks_case(), "blocks", still, {});
  ASSERT_TRUE(live.start(virtual_hand(), Pose{}));
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  const Pose left{Vec3(-0.03, 0, 0.15), Quat::Identity()};
  ASSERT_TRUE(live.add_hand(left, 0));
  run_until(live, [&] { return live.snapshot().tool.tick > 200 && !live.others().empty(); });
  EXPECT_TRUE(live.rests(0));
  const Vec3 rested = live.others()[0].X_WP.p;
  run_until(live, [&] { return live.others()[0].tick > 300; });
  EXPECT_LT((live.others()[0].X_WP.p - rested).norm(), 1e-9);
  EXPECT_TRUE(live.change_hands());
  EXPECT_TRUE(live.rests(1));
}

TEST(LiveHands, ARestorePointIsKeptAndGoneBackTo) {
  LiveRun live(test::blocks_case(), "blocks", leaping_path(), {});
  ASSERT_TRUE(live.start(choice_named("mouse"), Pose{Vec3(0, 0, 0.1), Quat::Identity()}));
  const auto told = [&](EventKind kind) {
    for (const RunEvent& e : live.events().events())
      if (e.event.kind == kind) return true;
    return false;
  };
  run_until(live, [&] { return told(EventKind::kMark); });
  EXPECT_FALSE(told(EventKind::kRestored));
  ASSERT_TRUE(live.undo());
  run_until(live, [&] { return told(EventKind::kRestored); });
}

TEST(LiveHands, TheMouseGoesOnAfterALeapThatWouldStopAMotor) {
  LiveRun live(test::blocks_case(), "blocks", leaping_path(), {});
  const Pose start{Vec3(0, 0, 0.1), Quat::Identity()};
  ASSERT_TRUE(live.start(choice_named("mouse"), start));
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  Pose far = start;
  far.p.x() += 0.3;
  live.bring(far);
  std::string why;
  run_until(live, [&] { return !(why = live.take_harmless_trip()).empty(); });
  EXPECT_NE(why.find("1 m/s"), std::string::npos);
  run_until(live, [&] {
    return live.device_status().cause == ForceOff::kNone &&
           (live.snapshot().tool.X_WP.p - far.p).norm() < 1e-3;
  });
}

TEST(LiveHands, ARecordingOfACaseInAFolderKnowsWhereThatStood) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "some_case";
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("live_path_" + std::to_string(::getpid()) + ".osr");
  LiveRun live(test::blocks_case(), folder.string() + "#near=hull", leaping_path(), {});
  ASSERT_TRUE(live.start(choice_named("mouse"), Pose{Vec3(0, 0, 0.1), Quat::Identity()}));
  ASSERT_TRUE(live.start_recording(file));
  EXPECT_FALSE(live.add_hand(Pose{}, 0));
  ASSERT_TRUE(live.end());
  const auto recording = load_recording(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->header.case_path, folder.string());
}

// Down into the block with a drill that runs, and on for a minute.
ProbePath drilling_path() {
  ProbePath path;
  path.with_instruments = true;
  for (const auto& [time_s, z] : {std::pair{0.0, 0.001}, {0.2, -0.003}, {60.0, -0.003}}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(0.0003, 0.0002, testing::kTop_m + z);
    sample.instrument = "drill";
    sample.size_mm = 3.2;
    sample.power = 1;
    path.samples.push_back(sample);
  }
  return path;
}

// The hand that is left rests; its key or pedal is the other one's now.
TEST(LiveRunCarves, AMotorStopsInAHandThatIsLeft) {
  const testing::Drilling with("drill:3.2");
  const RunTray tray{{"drill:3.2"}, with.tray, {{true, false}}, with.setup};
  LiveRun live(with.the_case, "block", {}, {}, tray);
  const Pose first{Vec3(0, 0, 0.1), Quat::Identity()}, second{Vec3(0.05, 0, 0.1), Quat::Identity()};
  ASSERT_TRUE(live.start(choice_named("mouse"), first));
  run_until(live, [&] { return live.snapshot().tool.tick > 4; });
  ASSERT_TRUE(live.add_hand(second, 0));
  run_until(live, [&] {
    live.drive(1);
    return live.snapshot().tool.power == 1;
  });
  ASSERT_TRUE(live.change_hands());
  ASSERT_EQ(live.others()[0].power, 1);
  run_until(live, [&] {
    live.drive(0);
    return live.others()[0].power == 0;
  });
  EXPECT_EQ(live.others()[0].power, 0);
}

// What a path says of instruments and power is done, and what it drills is shown. A new run begins
// with whole bones.
TEST(LiveRunCarves, WhatAPathDrillsIsShown) {
  const testing::Drilling with("drill:3.2");
  const ProbePath path = drilling_path();
  RunTray tray{{"drill:3.2"}, with.tray, {{true, false}}, with.setup};
  LiveRun live(with.the_case, "block", path, {}, tray);
  ASSERT_TRUE(live.start(virtual_hand(), Pose{}));
  std::size_t triangles = 0;
  run_until(live, [&] {
    for (const CarvedPicture::Changed& changed : live.carved().changes())
      for (const SurfaceCube& cube : changed.cubes)
        for (const float depth_m : cube.depth_m) triangles += depth_m > 0.0005f ? 1 : 0;
    return triangles > 50;
  });
  EXPECT_EQ(live.snapshot().tool.power, 1);
  const std::uint64_t number = live.run_number();
  ASSERT_TRUE(live.start(virtual_hand(), Pose{}));
  EXPECT_GT(live.run_number(), number);
  EXPECT_TRUE(live.carved().changes().empty());
}

// Otherwise its replay would remove them in another way.
TEST(LiveRunCarves, ARecordingSaysHowItsBonesWereRemoved) {
  const testing::Drilling with("drill:3.2");
  RunTray tray{{"drill:3.2"}, with.tray, {{true, false}}, with.setup};
  tray.carve.cortex_m = 0.003;
  tray.carve.irrigation_ml_per_min = 60;
  LiveRun live(with.the_case, "block", {}, {}, tray);
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("live_carve_" + std::to_string(::getpid()) + ".osr");
  ASSERT_TRUE(live.start(choice_named("mouse"), Pose{Vec3(0, 0, 0.1), Quat::Identity()}));
  ASSERT_TRUE(live.start_recording(file));
  ASSERT_TRUE(live.end());
  const auto recording = load_recording(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(recording) << recording.error().message();
  const auto settings = parse_settings(recording->header.settings_json);
  ASSERT_TRUE(settings);
  EXPECT_TRUE(settings->carve.on);
  EXPECT_EQ(settings->carve.cortex_m, 0.003);
  EXPECT_EQ(settings->carve.irrigation_ml_per_min, 60);
}

std::filesystem::path named(const char* name) {
  return std::filesystem::path(::testing::TempDir()) / (name + std::to_string(::getpid()) + ".osr");
}

// Another hand goes on where a recorded one has come: what that has drilled is there, and the whole
// repeats from the new recording.
TEST(LiveRunCarves, ItGoesOnWithARunThatWasBegun) {
  const testing::Drilling with("drill:3.2");
  const ProbePath path = drilling_path();
  const RunTray tray{{"drill:3.2"}, with.tray, {{true, false}}, with.setup};
  const auto first = named("begin_"), second = named("go_on_");
  {
    LiveRun live(with.the_case, "block", path, {}, tray);
    ASSERT_TRUE(live.start(virtual_hand(), Pose{}));
    ASSERT_TRUE(live.start_recording(first));
    run_until(live, [&] { return live.snapshot().tool.tick > 900; });
    ASSERT_TRUE(live.end());
  }
  BegunOrder order{first, second, with.the_case, "block", tray, {}, {}, {}};
  order.place = [](const std::string&) { return 0u; };
  order.on_tick = [](std::span<const ToolState* const> tools, const BoneSnapshot&) {
    return tools[0]->tick < 800;
  };
  auto begun = begin_run(order);
  ASSERT_TRUE(begun) << begun.error().message();
  EXPECT_EQ(begun->tools[0].tick, 800u);
  const std::size_t cut = begun->carved->cut_bones().size();
  EXPECT_GT(cut, 0u);
  const Vec3 tip_W = begun->tools[0].X_WD.p;
  LiveRun live(with.the_case, "block", {}, {}, tray);
  ASSERT_TRUE(live.start(choice_named("mouse"), Pose{Vec3(0, 0, 0.1), Quat::Identity()}));
  ASSERT_TRUE(live.go_on(std::move(*begun)));
  EXPECT_TRUE(live.recording());
  EXPECT_EQ(live.carved().cut_bones().size(), cut);
  run_until(live, [&] { return live.snapshot().tool.tick > 1000; });
  EXPECT_LT((live.snapshot().tool.X_WD.p - tip_W).norm(), 1e-9) << "where the hand before it was";
  ToolState judged;
  ASSERT_TRUE(live.pop_judged(judged, 0));
  EXPECT_EQ(judged.tick, 801u);
  ASSERT_TRUE(live.end());
  auto recording = RecordingReader::open(second);
  ASSERT_TRUE(recording) << recording.error().message();
  ReplayOptions options;
  options.tray = with.tray;
  options.carving = with.setup;
  options.reported_after = 800;
  const auto replayed = replay(*recording, with.the_case, options);
  ASSERT_TRUE(replayed) << replayed.error().message();
  EXPECT_TRUE(replayed->identical) << replayed->first_different_tick;
  EXPECT_TRUE(replayed->complete);
  EXPECT_GT(replayed->ticks, 1000u);
  EXPECT_NEAR(replayed->report.duration_s, 0.001 * static_cast<double>(replayed->ticks - 800),
              1e-9);
  std::filesystem::remove(first);
  std::filesystem::remove(second);
}

// An expert who holds nothing that removes bone recorded no carving; whoever goes on has tools that
// could.
TEST(LiveRunCarves, ItGoesOnWithARunThatRemovedNothing) {
  const testing::Drilling with("drill:3.2");
  ProbePath path = drilling_path();
  for (PathSample& sample : path.samples) sample.power = 0;
  const RunTray plain{{"drill:3.2"}, with.tray, {{true, false}}};
  RunTray carving = plain;
  carving.carving = with.setup;
  const auto first = named("plain_"), second = named("after_plain_"), third = named("after_that_");
  {
    LiveRun live(with.the_case, "block", path, {}, plain);
    ASSERT_TRUE(live.start(virtual_hand(), Pose{}));
    ASSERT_TRUE(live.start_recording(first));
    run_until(live, [&] { return live.snapshot().tool.tick > 900; });
    ASSERT_TRUE(live.end());
  }
  BegunOrder order{first, second, with.the_case, "block", carving, {}, {}, {}};
  order.place = [](const std::string&) { return 0u; };
  order.on_tick = [](std::span<const ToolState* const> tools, const BoneSnapshot&) {
    return tools[0]->tick < 800;
  };
  {
    const auto begun = begin_run(order);
    ASSERT_TRUE(begun) << begun.error().message();
    EXPECT_TRUE(begun->settings.carve.on);
    EXPECT_EQ(begun->tools[0].tick, 800u);
    EXPECT_TRUE(begun->carved->cut_bones().empty());
  }
  // Bone that was removed would be whole again.
  const BegunOrder back{second,      third, with.the_case, "block", plain,
                        order.place, {},    order.on_tick};
  EXPECT_FALSE(begin_run(back));
  std::filesystem::remove(first);
  std::filesystem::remove(second);
}

}  // namespace
}  // namespace osteon
