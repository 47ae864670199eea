// Two devices in one world: the fault of one is its own, and the recording holds both.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "app/loops/runtime_rig.h"

namespace osteon {
namespace {

using test::DeviceLog;
using test::FakeDevice;
using test::TemporaryFile;

constexpr int kTicks = 1200;
constexpr int kFaultTick = 900;

RunPlan plan_of_two() {
  RunPlan plan = test::plan_on(test::blocks_case());
  plan.settings.hands = {{"left", 0}, {"right", 0}};
  return plan;
}

// The second hand presses the other block.
DeviceSample far_press(std::uint64_t tick) {
  DeviceSample sample = test::press_and_slide(tick);
  sample.X_VD.p.x() += 0.03;
  return sample;
}

std::vector<HandPlan> two_devices(const FakeDevice::Script& left, const FakeDevice::Script& right,
                                  DeviceLog& left_log, DeviceLog& right_log) {
  std::vector<HandPlan> hands(2);
  hands[0].device = std::make_unique<FakeDevice>(left, left_log);
  hands[1].device = std::make_unique<FakeDevice>(right, right_log);
  return hands;
}

std::unique_ptr<RecordFeed> feed_of_two(const std::filesystem::path& file, const RunPlan& plan,
                                        const Tray& tray = {}) {
  auto writer = RecordingWriter::create(
      file, recording_header(*plan.the_case, plan.settings, "test", "test", tray));
  EXPECT_TRUE(writer);
  return std::make_unique<RecordFeed>(std::move(*writer), 8.0, 2);
}

void run_all(Runtime& runtime, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    runtime.step_haptic_once(0);
    runtime.step_haptic_once(1);
    if (i % 2 == 1) runtime.step_physics_once();
    runtime.drain_records_once();
  }
}

struct FaultRow {
  std::string name;
  std::function<void(DeviceSample&)> fault;
  ForceOff cause;
};

std::vector<FaultRow> fault_rows() {
  return {
      {"unplugged", [](DeviceSample& s) { s.connected = false; }, ForceOff::kDisconnect},
      {"not finite", [](DeviceSample& s) { s.X_VD.p.y() = std::nan(""); }, ForceOff::kNotFinite},
      {"infinite velocity",
       [](DeviceSample& s) { s.v_V.x() = std::numeric_limits<double>::infinity(); },
       ForceOff::kNotFinite},
      {"too fast", [](DeviceSample& s) { s.v_V.z() = 1.1; }, ForceOff::kVelocity},
      {"too warm", [](DeviceSample& s) { s.refusal = ForceOff::kTemperature; },
       ForceOff::kTemperature},
      {"its own watchdog", [](DeviceSample& s) { s.refusal = ForceOff::kWatchdog; },
       ForceOff::kWatchdog},
      {"its own fault", [](DeviceSample& s) { s.refusal = ForceOff::kDeviceFault; },
       ForceOff::kDeviceFault},
      {"no longer calibrated", [](DeviceSample& s) { s.calibrated = false; },
       ForceOff::kCalibration},
      {"let go", [](DeviceSample& s) { s.dead_man_held = false; }, ForceOff::kDeadMan},
  };
}

// Whatever befalls the right device, its force is zero from that tick on, its tool stands still
// though the hand goes away, and the left hand's force has the same bits as if nothing had
// happened.
TEST(RuntimeTwoHands, AFaultOfOneLeavesTheOthersForceAsItWas) {
  DeviceLog left_sound, right_sound;
  {
    Runtime runtime(plan_of_two(),
                    two_devices(test::press_and_slide, far_press, left_sound, right_sound));
    run_all(runtime, kTicks);
  }
  ASSERT_GT(left_sound.forces_V[kTicks - 1].norm(), 0.5);
  ASSERT_GT(right_sound.forces_V[kTicks - 1].norm(), 0.5);
  for (const FaultRow& row : fault_rows()) {
    DeviceLog left, right;
    const auto faulty = [&row](std::uint64_t tick) {
      DeviceSample sample = far_press(tick);
      if (tick >= kFaultTick) {
        sample.X_VD.p.z() += 1e-4 * static_cast<double>(tick - kFaultTick);
        row.fault(sample);
      }
      return sample;
    };
    Runtime runtime(plan_of_two(), two_devices(test::press_and_slide, faulty, left, right));
    run_all(runtime, kFaultTick);
    const Vec3 place_W = runtime.session().tool_state(1).X_WD.p;
    EXPECT_GT(right.forces_V.back().norm(), 0.5) << row.name;
    run_all(runtime, kTicks - kFaultTick);
    for (int i = 0; i < kTicks; ++i)
      ASSERT_EQ(left.forces_V[i], left_sound.forces_V[i]) << row.name << " " << i;
    for (int i = kFaultTick; i < kTicks; ++i)
      ASSERT_EQ(right.forces_V[i], Vec3::Zero()) << row.name << " " << i;
    EXPECT_EQ(runtime.device_status(0).cause, ForceOff::kNone) << row.name;
    EXPECT_EQ(runtime.device_status(1).cause, row.cause) << row.name;
    EXPECT_LT((runtime.session().tool_state(1).X_WD.p - place_W).norm(), 1e-4) << row.name;
  }
}

// Both have a fault; the user takes up one.
TEST(RuntimeTwoHands, AForceThatIsResumedIsThatHandsAlone) {
  DeviceLog left, right;
  const auto unplugged = [](const FakeDevice::Script& script) {
    return [script](std::uint64_t tick) {
      DeviceSample sample = script(tick);
      sample.connected = tick < 700 || tick >= 720;
      return sample;
    };
  };
  Runtime runtime(plan_of_two(),
                  two_devices(unplugged(test::press_and_slide), unplugged(far_press), left, right));
  run_all(runtime, 800);
  ASSERT_EQ(left.forces_V.back(), Vec3::Zero());
  ASSERT_EQ(right.forces_V.back(), Vec3::Zero());
  runtime.set_force_enabled(true, 1);
  run_all(runtime, 900);
  EXPECT_GT(right.forces_V.back().norm(), 0.5);
  EXPECT_EQ(runtime.device_status(1).cause, ForceOff::kNone);
  for (std::size_t i = 800; i < left.forces_V.size(); ++i)
    ASSERT_EQ(left.forces_V[i], Vec3::Zero()) << i;
  EXPECT_EQ(runtime.device_status(0).cause, ForceOff::kDisconnect);
}

// The hand went 20 mm up while the force was off. Resumed, the tool goes there within the ramp and
// without a jump.
TEST(RuntimeTwoHands, AFrozenToolComesBackToItsHandWithoutAJump) {
  DeviceLog left, right;
  const auto too_fast = [](std::uint64_t tick) {
    DeviceSample sample = far_press(tick);
    if (tick >= kFaultTick) sample.X_VD.p.z() += std::min(0.02, 1e-4 * double(tick - kFaultTick));
    if (tick == kFaultTick) sample.v_V.z() = 1.1;
    return sample;
  };
  Runtime runtime(plan_of_two(), two_devices(test::press_and_slide, too_fast, left, right));
  run_all(runtime, kTicks);
  const Session& session = runtime.session();
  const double frozen_z = session.tool_state(1).X_WD.p.z();
  EXPECT_NEAR(frozen_z, -0.002, 1e-4);
  EXPECT_EQ(session.tool_state(1).v_W, Vec3::Zero());
  runtime.set_force_enabled(true, 1);
  double last_z = frozen_z;
  for (int i = 0; i < 250; ++i) {
    run_all(runtime, 2);
    const double z = session.tool_state(1).X_WD.p.z();
    ASSERT_LE(std::abs(z - last_z), 1e-4) << i;
    last_z = z;
  }
  EXPECT_NEAR(last_z - frozen_z, 0.02, 1e-6);
}

// A demonstration plays on: see HapticStageOptions.
TEST(RuntimeTwoHands, AHandThatIsAskedNotToFreezeMovesOnWithoutForce) {
  DeviceLog left, right;
  const auto let_go = [](std::uint64_t tick) {
    DeviceSample sample = far_press(tick);
    sample.dead_man_held = tick < kFaultTick;
    if (tick >= kFaultTick) sample.X_VD.p.z() += 1e-4 * static_cast<double>(tick - kFaultTick);
    return sample;
  };
  std::vector<HandPlan> hands = two_devices(test::press_and_slide, let_go, left, right);
  hands[1].freezes = false;
  Runtime runtime(plan_of_two(), std::move(hands));
  run_all(runtime, kTicks);
  EXPECT_GT(runtime.session().tool_state(1).X_WD.p.z(), 0.02);
  EXPECT_EQ(right.forces_V.back(), Vec3::Zero());
}

TEST(RuntimeTwoHands, OneRecordingHoldsBothTheirFaultsAndTheirRestorePoints) {
  const TemporaryFile file("two.osr");
  DeviceLog left, right;
  RunPlan plan = plan_of_two();
  plan.settings.physics.hold_bones = false;
  {
    const auto faulty = [](std::uint64_t tick) {
      DeviceSample sample = far_press(tick);
      sample.connected = tick < kFaultTick;
      return sample;
    };
    Runtime runtime(plan, two_devices(test::press_and_slide, faulty, left, right),
                    feed_of_two(file.path(), plan));
    run_all(runtime, 300);
    EXPECT_TRUE(runtime.send({CommandKind::kMark, 2}));
    run_all(runtime, 300);
    EXPECT_TRUE(runtime.send({CommandKind::kRestore, 2}));
    run_all(runtime, kTicks - 600);
    EXPECT_EQ(runtime.session().tool_state(0).epoch, 1u);
    EXPECT_EQ(runtime.session().tool_state(1).epoch, 1u);
    EXPECT_EQ(runtime.session().bones().epoch, 1u);
    ASSERT_TRUE(runtime.stop());
  }
  const auto recording = load_recording(file.path());
  ASSERT_TRUE(recording) << recording.error().message();
  ASSERT_EQ(recording->hands(), 2u);
  ASSERT_FALSE(recording->states.empty());
  const auto seen = [&](EventKind kind) {
    return std::count_if(recording->events.begin(), recording->events.end(),
                         [kind](const Event& event) { return event.kind == kind; });
  };
  EXPECT_EQ(seen(EventKind::kMark), 1);
  EXPECT_EQ(seen(EventKind::kRestored), 1);
  EXPECT_EQ(seen(EventKind::kFault), 1);
  EXPECT_GE(seen(EventKind::kContactBegin), 2);
  std::uint64_t hash = 0;
  for (const double from_s : {0.0, 0.5}) {
    ReplayOptions options;
    options.from_s = from_s;
    const auto outcome = replay(*recording, plan.the_case, options);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
    if (from_s > 0) {
      EXPECT_GT(outcome->first_tick, 1u);
      EXPECT_EQ(outcome->state_hash, hash);
    }
    hash = outcome->state_hash;
  }
}

// For the thread sanitizer: both hands, physics, writer and the window at once, with restore
// points and exchanges of instruments.
TEST(RuntimeTwoHands, OnThreadsExchangeCleanlyAndReplayFromAnyState) {
  constexpr int kMany = 800;
  const TemporaryFile file("threads.osr");
  DeviceLog left, right;
  RunPlan plan = plan_of_two();
  plan.settings.physics.hold_bones = false;
  plan.settings.tray = {"thin", "thick"};
  const Tray tray = {std::make_shared<const Tool>(make_wrist_probe(0.00075)),
                     std::make_shared<const Tool>(make_wrist_probe(0.0015))};
  const auto faulty = [](std::uint64_t tick) {
    DeviceSample sample = test::press_and_slide(tick);
    sample.connected = tick < 400 || tick >= 420;
    return sample;
  };
  {
    Runtime runtime(plan, two_devices(test::press_and_slide, faulty, left, right),
                    feed_of_two(file.path(), plan, tray), tray);
    // The window wishes something every 20 ticks; no loop outruns it.
    constexpr int kWishes = 40;
    std::atomic<int> allowed{0};
    const auto wait_for = [&allowed](int tick) {
      while (allowed.load() <= tick) std::this_thread::yield();
    };
    std::vector<std::thread> threads;
    for (std::size_t h = 0; h < 2; ++h)
      threads.emplace_back([&runtime, &wait_for, h] {
        for (int i = 0; i < kMany; ++i) {
          wait_for(i);
          runtime.step_haptic_once(h);
        }
      });
    threads.emplace_back([&runtime, &wait_for] {
      for (int i = 0; i < kMany; i += 2) {
        wait_for(i);
        runtime.step_physics_once();
      }
    });
    threads.emplace_back([&runtime, &wait_for] {
      for (int i = 0; i < kMany; ++i) {
        wait_for(i);
        runtime.drain_records_once();
      }
    });
    for (int i = 0; i < kWishes; ++i) {
      const double mark = i % 4;
      runtime.send({i % 3 == 2 ? CommandKind::kRestore : CommandKind::kMark, mark});
      runtime.send({CommandKind::kTake, static_cast<double>(i / 2 % 2)}, i % 2);
      runtime.send({CommandKind::kPower, 0.25 * (i % 5)}, (i + 1) % 2);
      if (i % 8 == 7) runtime.set_force_enabled(true, 1);
      allowed += kMany / kWishes;
      runtime.snapshot(0);
      runtime.snapshot(1);
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_TRUE(runtime.stop());
  }
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader) << reader.error().message();
  const auto states = reader->states();
  ASSERT_TRUE(states);
  std::uint64_t hash = 0;
  ReplayOptions options;
  options.tray = tray;
  std::map<EventKind, int> seen;
  options.on_tick = [&](std::size_t, const ToolState&, const BoneSnapshot&,
                        std::span<const Event> events) {
    for (const Event& event : events) ++seen[event.kind];
  };
  const auto whole = replay(*reader, plan.the_case, options);
  ASSERT_TRUE(whole) << whole.error().message();
  EXPECT_TRUE(whole->identical) << whole->first_different_hand << " "
                                << whole->first_different_tick;
  for (const EventKind kind : {EventKind::kMark, EventKind::kRestored, EventKind::kInstrumentTaken,
                               EventKind::kPowered, EventKind::kFault})
    EXPECT_GT(seen[kind], 0) << find_event_kind(kind)->name;
  hash = whole->state_hash;
  for (const StoredState& state : *states) {
    options.from_s = static_cast<double>(state.ticks[0]) * 0.001;
    const auto outcome = replay(*reader, plan.the_case, options);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical);
    EXPECT_EQ(outcome->state_hash, hash);
  }
}

}  // namespace
}  // namespace osteon
