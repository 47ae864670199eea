// The loops on threads of their own, as in the program: what the thread sanitizer looks at.
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "app/loops/runtime_rig.h"
#include "device/phantom/stub_library.h"

namespace osteon {
namespace {

using test::DeviceLog;
using test::expect_identical_replay;
using test::FakeDevice;
using test::feed_to;
using test::plan_on;
using test::run_both;
using test::TemporaryFile;

// The same three threads as in the window, as fast as they go: for the thread sanitizer.
TEST(RuntimeThreads, LoopsOnThreadsExchangeCleanlyAndReplay) {
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

TEST(RuntimeThreads, StartsAndStopsItsThreadsMoreThanOnce) {
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

// Two hands: each device with its stage, its session and its thread, on one case.
TEST(RuntimeThreads, TwoDevicesRunAtOnceOnThreadsOfTheirOwn) {
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

// The library's servo thread, three threads for each arm and one that looks at both, as `osteon
// live` has them. How far they come in real time does not matter.
TEST(RuntimeThreads, TwoArmsOfOneLibraryRunStartedSideBySide) {
  ::setenv("STUB_HD_THREAD", "1", 1);
  testing::StubLibrary stub;
  const TemporaryFile left_file("left.osr"), right_file("right.osr");
  const RunPlan plan = plan_on(test::blocks_case());
  {
    const auto session = stub.session();
    Runtime left(plan, PhantomDevice::open(session, "Left Device").value(),
                 feed_to(left_file.path(), plan));
    Runtime right(plan, PhantomDevice::open(session, "Right Device").value(),
                  feed_to(right_file.path(), plan));
    left.start();
    right.start();
    while (left.snapshot().tool.tick < 100 || right.snapshot().tool.tick < 100) {
      left.set_hand_wishes({});
      left.device_status();
      right.device_status();
      right.set_force_enabled(true);
      std::this_thread::yield();
    }
    ASSERT_TRUE(left.stop());
    ASSERT_TRUE(right.stop());
  }
  EXPECT_TRUE(testing::motor_force(*stub.left).isZero(0));
  EXPECT_TRUE(testing::motor_force(*stub.right).isZero(0));
  EXPECT_EQ(stub.misuses(), 0u);
  for (const TemporaryFile* file : {&left_file, &right_file}) {
    const auto recording = load_recording(file->path());
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_GE(recording->ticks.size(), 100u);
    expect_identical_replay(file->path(), plan.the_case, recording->ticks.size());
  }
  ::unsetenv("STUB_HD_THREAD");
}

}  // namespace
}  // namespace osteon
