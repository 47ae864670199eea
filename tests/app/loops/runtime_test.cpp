#include "loops/runtime.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "app/loops/fake_device.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::DeviceLog;
using test::FakeDevice;

RunPlan plan_on(std::shared_ptr<const Case> the_case) {
  RunPlan plan;
  plan.the_case = std::move(the_case);
  return plan;
}

// A file name in a fresh folder, removed with everything in it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const char* name) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              (std::string("osteon-") + test->name() + "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    path_ = folder_ / name;
  }
  ~TemporaryFile() {
    std::error_code ec;
    fs::remove_all(folder_, ec);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path folder_, path_;
};

std::unique_ptr<RecordFeed> feed_to(const fs::path& file, const RunPlan& plan,
                                    double seconds = 8.0) {
  RecordingHeader header;
  header.case_name = plan.the_case->name;
  header.case_source = "test";
  header.case_hash = plan.the_case->hash;
  header.settings_json = to_json(plan.settings);
  header.osteon_version = "test";
  auto writer = RecordingWriter::create(file, header);
  EXPECT_TRUE(writer) << (writer ? "" : writer.error().message());
  return writer ? std::make_unique<RecordFeed>(std::move(*writer), seconds) : nullptr;
}

void expect_identical_replay(const fs::path& file, std::shared_ptr<const Case> the_case,
                             std::uint64_t ticks) {
  const auto recording = load_recording(file);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_TRUE(recording->complete);
  const auto outcome = replay(*recording, std::move(the_case));
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << "differs at tick " << outcome->first_different_tick;
  EXPECT_EQ(outcome->ticks, ticks);
}

// Both loops in step: without physics the watchdog would rightly take the force away.
void run_both(Runtime& runtime, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    runtime.step_haptic_once();
    if (i % 2 == 1) runtime.step_physics_once();
  }
}

TEST(Runtime, PressingOnBonePushesTheHandBack) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  for (int i = 0; i < 1000; ++i) {
    runtime.step_haptic_once();
    if (i % 2 == 0) runtime.step_physics_once();
  }
  ASSERT_EQ(log.forces_V.size(), 1000u);
  EXPECT_EQ(log.forces_V.front(), Vec3::Zero());
  EXPECT_GT(log.forces_V.back().z(), 0.5);
  const RenderSnapshot& shown = runtime.snapshot();
  EXPECT_EQ(shown.tool.tick, 1000u);
  ASSERT_GE(shown.tool.contact_count, 1u);
  EXPECT_EQ(shown.tool.contacts[0].bone, BoneId{0});
  EXPECT_GT(shown.tool.X_WP.p.z(), shown.tool.X_WD.p.z());
}

TEST(Runtime, TelemetryTellsForceAndBone) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 400);
  Telemetry point;
  int points = 0, touching = 0;
  while (runtime.pop_telemetry(point)) {
    ++points;
    if (point.bones_mask == 0) continue;
    ++touching;
    EXPECT_EQ(point.bones_mask, 1u);
  }
  EXPECT_EQ(points, 100);
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 100);
}

TEST(Runtime, AReadingThatIsNotFiniteSwitchesTheForceOffAndSaysWhy) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    DeviceLog log;
    Runtime runtime(plan_on(test::blocks_case()), std::make_unique<FakeDevice>(
                                                      [bad](std::uint64_t tick) {
                                                        DeviceSample sample =
                                                            test::press_and_slide(tick);
                                                        if (tick == 900) sample.X_VD.p.y() = bad;
                                                        return sample;
                                                      },
                                                      log));
    run_both(runtime, 1000);
    EXPECT_GT(log.forces_V[899].norm(), 0.5);
    for (std::size_t i = 900; i < 1000; ++i) EXPECT_EQ(log.forces_V[i], Vec3::Zero()) << i;
    EXPECT_EQ(runtime.device_status().cause, ForceOff::kNotFinite);
    EXPECT_EQ(runtime.device_status().bad_samples, 1u);
    EXPECT_TRUE(is_finite(runtime.snapshot().tool.X_WP));
  }
}

TEST(Runtime, ADeviceThatIsUnpluggedStaysOffUntilTheUserResumes) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()), std::make_unique<FakeDevice>(
                                                    [](std::uint64_t tick) {
                                                      DeviceSample sample =
                                                          test::press_and_slide(tick);
                                                      sample.connected = tick < 800 || tick >= 900;
                                                      return sample;
                                                    },
                                                    log));
  run_both(runtime, 1000);
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kDisconnect);
  EXPECT_EQ(log.forces_V[950], Vec3::Zero());
  runtime.set_force_enabled(true);
  run_both(runtime, 1000);
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kNone);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
}

TEST(Runtime, PanicTakesEffectInTheNextTick) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 900);
  ASSERT_GT(log.forces_V.back().norm(), 0.5);
  runtime.set_force_enabled(false);
  runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
}

TEST(Runtime, TheForceStaysOffInARunThatStartsWithItOff) {
  DeviceLog log;
  RunPlan plan = plan_on(test::blocks_case());
  plan.force_enabled = false;
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 1000);
  for (const Vec3& force : log.forces_V) ASSERT_EQ(force, Vec3::Zero());
}

TEST(Runtime, TheMappingTurnsPositionsAndForces) {
  DeviceLog log;
  RunPlan plan = plan_on(test::blocks_case());
  // The device's y axis is World's z: the press of the script comes along V's y.
  plan.mapping.X_WV.q = Quat(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()));
  Runtime runtime(plan, std::make_unique<FakeDevice>(
                            [](std::uint64_t tick) {
                              const DeviceSample w = test::press_and_slide(tick);
                              DeviceSample v = w;
                              v.X_VD.p = Vec3(w.X_VD.p.x(), w.X_VD.p.z(), -w.X_VD.p.y());
                              v.v_V = Vec3(w.v_V.x(), w.v_V.z(), -w.v_V.y());
                              return v;
                            },
                            log));
  run_both(runtime, 1000);
  EXPECT_GT(log.forces_V.back().y(), 0.5);
  EXPECT_LT(std::abs(log.forces_V.back().z()), 0.2);
  EXPECT_GT(runtime.snapshot().tool.force_W.z(), 0.5);
}

TEST(Runtime, ClosesTheDeviceWithZeroForce) {
  DeviceLog log;
  {
    Runtime runtime(plan_on(test::blocks_case()),
                    std::make_unique<FakeDevice>(test::press_and_slide, log));
    run_both(runtime, 900);
    ASSERT_NE(log.forces_V.back(), Vec3::Zero());
  }
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_TRUE(log.closed);
}

// The loops in an order that no clock would give, with commands in between.
TEST(Runtime, ARunOfInterleavedLoopsReplaysIdentically) {
  const TemporaryFile file("run.osr");
  DeviceLog log;
  RunPlan plan = plan_on(test::blocks_case());
  plan.settings.physics.hold_bones = false;
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log),
                  feed_to(file.path(), plan));
  Random random(11);
  for (int i = 0; i < 1500; ++i) {
    runtime.step_haptic_once();
    if (random.uniform() < 0.5) runtime.step_physics_once();
    if (random.uniform() < 0.1) runtime.drain_records_once();
    if (i == 500) runtime.send({CommandKind::kSetStiffness, 800});
    if (i == 700) runtime.send({CommandKind::kSetFrictionScale, 0});
    if (i == 900) runtime.send({CommandKind::kHoldBones, 1});
  }
  const Result<void> closed = runtime.stop();
  ASSERT_TRUE(closed) << closed.error().message();
  expect_identical_replay(file.path(), plan.the_case, 1500);
}

TEST(Runtime, BadReadingsDoNotSpoilTheRecording) {
  const TemporaryFile file("bad.osr");
  DeviceLog log;
  const RunPlan plan = plan_on(test::blocks_case());
  Runtime runtime(plan,
                  std::make_unique<FakeDevice>(
                      [](std::uint64_t tick) {
                        DeviceSample sample = test::press_and_slide(tick);
                        if (tick % 7 == 3) sample.v_V.x() = std::nan("");
                        return sample;
                      },
                      log),
                  feed_to(file.path(), plan));
  for (int i = 0; i < 300; ++i) {
    runtime.step_haptic_once();
    if (i % 2 == 1) runtime.step_physics_once();
  }
  ASSERT_TRUE(runtime.stop());
  expect_identical_replay(file.path(), plan.the_case, 300);
}

TEST(Runtime, ADiskThatIsTooSlowEndsTheRecordingNotTheRun) {
  const TemporaryFile file("slow.osr");
  DeviceLog log;
  const RunPlan plan = plan_on(test::blocks_case());
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log),
                  feed_to(file.path(), plan, 0.2));  // room for 200 ticks, nobody drains
  for (int i = 0; i < 600; ++i) {
    runtime.step_haptic_once();
    if (i % 2 == 1) runtime.step_physics_once();
  }
  EXPECT_EQ(runtime.snapshot().tool.tick, 600u);
  const Result<void> closed = runtime.stop();
  ASSERT_FALSE(closed);
  EXPECT_NE(closed.error().message().find("too slow"), std::string::npos);
  EXPECT_FALSE(runtime.recording());
  expect_identical_replay(file.path(), plan.the_case, 200);
}

// The same three threads as in the window, as fast as they go: for the thread sanitizer.
TEST(Runtime, LoopsOnThreadsExchangeCleanlyAndReplay) {
  constexpr int kTicks = 600;
  const TemporaryFile file("threads.osr");
  DeviceLog log;
  RunPlan plan = plan_on(test::blocks_case());
  plan.settings.physics.hold_bones = false;
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log),
                  feed_to(file.path(), plan));
  std::thread haptic([&] {
    for (int i = 0; i < kTicks; ++i) runtime.step_haptic_once();
  });
  std::thread physics([&] {
    for (int i = 0; i < kTicks / 2; ++i) runtime.step_physics_once();
  });
  std::thread writer([&] {
    for (int i = 0; i < kTicks; ++i) runtime.drain_records_once();
  });
  std::uint64_t newest = 0;
  for (int i = 0; i < 200; ++i) {
    EXPECT_GE(runtime.snapshot().tool.tick, newest);
    newest = runtime.snapshot().tool.tick;
    runtime.device_status();
    EXPECT_TRUE(runtime.recording());
    if (i == 50) runtime.send({CommandKind::kSetStiffness, 1000});
    if (i == 60) runtime.set_force_enabled(false);
    if (i == 70) runtime.send({CommandKind::kHoldBones, 1});
  }
  haptic.join();
  physics.join();
  writer.join();
  EXPECT_EQ(runtime.snapshot().tool.tick, static_cast<std::uint64_t>(kTicks));
  ASSERT_TRUE(runtime.stop());
  expect_identical_replay(file.path(), plan.the_case, kTicks);
}

TEST(Runtime, StartsAndStopsItsThreadsMoreThanOnce) {
  const TemporaryFile file("started.osr");
  DeviceLog log;
  const RunPlan plan = plan_on(test::blocks_case());
  std::uint64_t ticks = 0;
  {
    Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log),
                    feed_to(file.path(), plan));
    runtime.start();
    runtime.start();
    while (runtime.snapshot().tool.tick < 20) std::this_thread::yield();
    ASSERT_TRUE(runtime.stop());
    ASSERT_TRUE(runtime.stop());
    ticks = log.forces_V.size() - 3;  // the loop and each stop leave the motors at zero
  }
  expect_identical_replay(file.path(), plan.the_case, ticks);
}

TEST(Runtime, PhysicsThatStopsTakesTheForceAwayAndItStaysAway) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 900);
  const double pressed = log.forces_V.back().norm();
  ASSERT_GT(pressed, 0.5);
  for (int i = 0; i < 19; ++i) runtime.step_haptic_once();
  EXPECT_NEAR(log.forces_V.back().norm(), pressed, 0.05);
  for (int i = 0; i < 16; ++i) runtime.step_haptic_once();
  EXPECT_LT(log.forces_V.back().norm(), 0.6 * pressed);
  EXPECT_GT(log.forces_V.back().norm(), 0);
  for (int i = 0; i < 20; ++i) runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  run_both(runtime, 100);
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kWatchdog);
}

TEST(Runtime, ADeadManPedalMustBeHeldAndMustBeRepeated) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  HandWishes held;
  held.has_dead_man = held.dead_man_held = true;
  const auto run_telling = [&](int ticks) {
    for (int i = 0; i < ticks; i += 10) {
      runtime.set_hand_wishes(held);
      run_both(runtime, 10);
    }
  };
  run_telling(900);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  run_both(runtime, 240);  // a slow picture is no letting go
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  run_both(runtime, 20);  // a window that hangs is
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kDeadMan);
  run_telling(100);
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero()) << "re-armed by itself";
  runtime.set_force_enabled(true);
  run_telling(900);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  held.dead_man_held = false;
  runtime.set_hand_wishes(held);
  runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
}

TEST(Runtime, TheClutchTakesTheForceAwayAndItComesBackFromNothing) {
  const TemporaryFile file("clutch.osr");
  DeviceLog log;
  const RunPlan plan = plan_on(test::blocks_case());
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log),
                  feed_to(file.path(), plan));
  run_both(runtime, 900);
  const double pressed = log.forces_V.back().norm();
  HandWishes clutch;
  clutch.clutch = true;
  runtime.set_hand_wishes(clutch);
  run_both(runtime, 100);
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_TRUE(runtime.device_status().clutched);
  runtime.set_hand_wishes({});
  run_both(runtime, 10);
  EXPECT_GT(log.forces_V.back().norm(), 0);
  EXPECT_LT(log.forces_V.back().norm(), 0.05 * pressed);
  run_both(runtime, 600);
  EXPECT_NEAR(log.forces_V.back().norm(), pressed, 0.1 * pressed);
  ASSERT_TRUE(runtime.stop());
  expect_identical_replay(file.path(), plan.the_case, 1610);
}

TEST(Runtime, TheDeviceCanBeHandedToTheNextRunOpen) {
  DeviceLog log;
  Runtime first(plan_on(test::blocks_case()),
                std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(first, 900);
  ASSERT_TRUE(first.stop());
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  std::unique_ptr<HapticDevice> device = first.take_device();
  EXPECT_FALSE(log.closed);
  Runtime second(plan_on(test::blocks_case()), std::move(device));
  run_both(second, 900);
  EXPECT_TRUE(first.stop());
  EXPECT_FALSE(log.closed);
}

// Two hands: each device with its stage, its session and its thread, on one case.
TEST(Runtime, TwoDevicesRunAtOnceOnThreadsOfTheirOwn) {
  constexpr int kTicks = 600;
  const TemporaryFile left_file("left.osr"), right_file("right.osr");
  DeviceLog left_log, right_log;
  const RunPlan plan = plan_on(test::blocks_case());
  Runtime left(plan, std::make_unique<FakeDevice>(test::press_and_slide, left_log),
               feed_to(left_file.path(), plan));
  Runtime right(plan,
                std::make_unique<FakeDevice>(
                    [](std::uint64_t tick) {
                      DeviceSample sample = test::press_and_slide(tick);
                      sample.connected = tick < 300;  // the one's fault is not the other's
                      return sample;
                    },
                    right_log),
                feed_to(right_file.path(), plan));
  std::thread left_thread([&] { run_both(left, kTicks); });
  std::thread right_thread([&] { run_both(right, kTicks); });
  left_thread.join();
  right_thread.join();
  EXPECT_EQ(left.device_status().cause, ForceOff::kNone);
  EXPECT_EQ(right.device_status().cause, ForceOff::kDisconnect);
  EXPECT_GT(left_log.forces_V.back().norm(), 0.5);
  EXPECT_EQ(right_log.forces_V.back(), Vec3::Zero());
  ASSERT_TRUE(left.stop());
  ASSERT_TRUE(right.stop());
  expect_identical_replay(left_file.path(), plan.the_case, kTicks);
  expect_identical_replay(right_file.path(), plan.the_case, kTicks);
}

}  // namespace
}  // namespace osteon
