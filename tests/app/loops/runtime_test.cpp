#include "loops/runtime.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/loops/runtime_rig.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

using test::DeviceLog;
using test::expect_identical_replay;
using test::FakeDevice;
using test::feed_to;
using test::plan_on;
using test::run_both;
using test::TemporaryFile;

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
  EXPECT_NE(closed.error().message().find("too busy"), std::string::npos);
  EXPECT_FALSE(runtime.recording());
  expect_identical_replay(file.path(), plan.the_case, 200);
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

}  // namespace
}  // namespace osteon
