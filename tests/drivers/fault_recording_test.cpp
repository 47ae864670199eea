// Whatever goes wrong with a device in contact ends the force and nothing else: the run goes on,
// the user resumes, and what is recorded of it all is whole and repeats to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "device/falcon/falcon_rig.h"
#include "device/joystick/joystick_rig.h"
#include "device/phantom/stub_library.h"
#include "drivers/run_loop.h"
#include "drivers/two_loops.h"
#include "joystick/vector_report.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

using testing::JoystickRig;
using testing::kMs;
using testing::RunLoop;

// Ticks of a run: the hand leans on the block with all of the force, the fault comes and goes, and
// the user resumes.
constexpr int kFaultTick = 650, kHealedTick = 780, kResumedTick = 860, kEndTick = 960;

struct Fault {
  const char* name;
  std::vector<ForceOff> causes;  ///< any of them
  int bound_ms;                  ///< until the motors are at zero
  std::function<void()> come;
  std::function<void()> heal = [] {};
  std::function<void(LoopExchange&)> from_above = [](LoopExchange&) {};
};

// Along a line so long that the pull across it is no number, the layers above wish for one.
Fault not_a_number(int bound_ms) {
  Fault fault{"NaN from the layers above", {ForceOff::kNotFinite}, bound_ms, [] {}};
  fault.from_above = [](LoopExchange& exchange) {
    HandWishes wishes;
    wishes.guide = {true, Vec3::Zero(), Vec3::Constant(1e200), 1};
    exchange.hand_wishes.publish(wishes);
  };
  return fault;
}

/// A device in a hand.
struct Held {
  HapticDevice& device;
  std::function<void(const testing::WantedInV&)> lead;  ///< the hand and the world, by 1 ms
  std::function<Vec3()> motors;
};

ProbePath leaning_path() {
  ProbePath path;
  for (const auto& [time_s, z_mm] : {std::pair{0.0, 4.0}, {0.1, 4.0}, {0.4, -2.0}, {2.0, -2.0}})
    path.samples.push_back({time_s, {Vec3(0, 0, 1e-3 * z_mm)}, false});
  return path;
}

// What one run left.
struct Left {
  double force_before_n = 0;  ///< at the motors when the fault came
  int ms_to_zero = 0;         ///< from then on
  ForceOff cause = ForceOff::kNone;
};

Left run(const std::shared_ptr<const Case>& the_case, const Held& held, const Fault& fault,
         RecordFeed& feed) {
  RunLoop loop(the_case, held.device, testing::turned_mapping(), 1, true, &feed);
  const ProbePath path = leaning_path();
  Left left;
  for (int tick = 0; tick < kEndTick; ++tick) {
    if (tick == kFaultTick) {
      left.force_before_n = held.motors().norm();
      fault.come();
      fault.from_above(loop.exchange);
    }
    if (tick == kHealedTick) {
      fault.heal();
      loop.exchange.hand_wishes.publish({});
    }
    if (tick == kResumedTick) {
      left.cause = loop.status().cause;
      loop.exchange.to_gate.push(GateWish::kEnable);
    }
    held.lead(testing::wanted_in_V(path, 1e-3 * tick));
    loop.tick();
    (void)feed.drain();
    const bool at_fault = tick >= kFaultTick && tick < kResumedTick;
    if (at_fault && !held.motors().isZero(0)) left.ms_to_zero = tick - kFaultTick + 1;
  }
  return left;
}

class FaultRecording : public ::testing::Test {
 protected:
  FaultRecording()
      : file_(std::filesystem::path(::testing::TempDir()) /
              ("fault_recording_" + std::to_string(::getpid()) + ".osr")) {}
  ~FaultRecording() override { std::filesystem::remove(file_); }

  void expect_all_is_kept(const Held& held, const Fault& fault) {
    SCOPED_TRACE(fault.name);
    std::filesystem::remove(file_);
    auto writer = RecordingWriter::create(
        file_, recording_header(*case_, RunLoop::settings(), "blocks", "test"));
    ASSERT_TRUE(writer) << writer.error().message();
    RecordFeed feed(std::move(*writer));
    const Left left = run(case_, held, fault, feed);
    ASSERT_TRUE(feed.finish());
    EXPECT_GT(left.force_before_n, 0.5) << "no contact";
    EXPECT_LE(left.ms_to_zero, fault.bound_ms);
    EXPECT_NE(std::find(fault.causes.begin(), fault.causes.end(), left.cause), fault.causes.end())
        << describe(left.cause);
    expect_whole_recording();
  }

  void expect_whole_recording() {
    const auto recording = load_recording(file_);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->complete);
    EXPECT_EQ(recording->ticks.size(), static_cast<std::size_t>(kEndTick));
    const auto replayed = replay(*recording, case_);
    ASSERT_TRUE(replayed) << replayed.error().message();
    EXPECT_TRUE(replayed->identical) << "at tick " << replayed->first_different_tick;
    EXPECT_EQ(replayed->ticks, static_cast<std::uint64_t>(kEndTick));
  }

  void try_joystick(const testing::JoystickKind& kind);

  std::filesystem::path file_;
  std::shared_ptr<const Case> case_ = test::blocks_case();
};

// A stub arm whose library's loop may be late, led by a hand.
struct LedArm {
  LedArm() {
    lead(testing::wanted_in_V(leaning_path(), 0));
    device = PhantomDevice::open(stub.session(), "Left Device").value();
  }
  void lead(const testing::WantedInV& wanted) {
    testing::want(*stub.left, 1000 * wanted.X_VD.p + Vec3(0, 50, -30), 1000 * wanted.v_V);
    if (late_passes-- > 0)
      stub.stall(1);
    else
      stub.step(1);
  }
  Held held() {
    return {*device, [this](const testing::WantedInV& w) { lead(w); },
            [this] { return testing::motor_force(*stub.left); }};
  }
  testing::StubLibrary stub;
  std::unique_ptr<HapticDevice> device;
  int late_passes = 0;
};

std::vector<Fault> faults_of(LedArm& arm) {
  StubArm& left = *arm.stub.left;
  return {
      {"unplugged", {ForceOff::kDisconnect}, 1, [&] { left.plugged = false; }},
      {"silent for 100 ms", {ForceOff::kDisconnect}, 101, [&] { arm.late_passes = 100; }},
      {"the program stalls for 100 ms", {ForceOff::kWatchdog}, 0, [&] { arm.stub.step(100); }},
      {"garbage",
       {ForceOff::kDeviceFault},
       11,
       [&] { left.garbage = 2; },
       [&] { left.garbage = 0; }},
      {"over-velocity",
       {ForceOff::kVelocity},
       2,
       [&] { left.speed = 1500; },
       [&] { left.speed = 0; }},
      {"over-temperature",
       {ForceOff::kTemperature},
       11,
       [&] { left.temperature = 1.02; },
       [&] { left.temperature = 0.3; }},
      {"lost calibration",
       {ForceOff::kCalibration},
       11,
       [&] { left.calibration = hd::kCalibrationNeedsManualInput; },
       [&] { left.calibration = hd::kCalibrationOk; }},
      not_a_number(2),
      {"its own fault", {ForceOff::kDeviceFault}, 1, [&] { left.raise = hd::kDeviceFault; }},
      {"let go", {ForceOff::kDeadMan}, 1, [&] { left.switch_held = false; }},
      {"closed", {ForceOff::kDisconnect}, 0, [&] { arm.device->close(); }},
  };
}

// The hand beside the one with the fault leans on the other block.
std::vector<Vec3> felt_beside(const Held& held, const Fault* fault) {
  VirtualDevice hand(held.device.info());
  testing::Recorder other(hand);
  testing::TwoLoops loops(test::blocks_case(), RunLoop::settings(), held.device, other);
  ProbePath beside = leaning_path();
  for (PathSample& sample : beside.samples) sample.X_WD.p.x() += 0.03;
  bool on = false;
  int ms_to_zero = 0;
  for (int tick = 0; tick < kEndTick; ++tick) {
    if (fault && tick == kFaultTick) {
      on = held.motors().norm() > 0.5;
      fault->come();
      fault->from_above(loops.exchange(0));
    }
    if (fault && tick == kHealedTick) {
      fault->heal();
      loops.exchange(0).hand_wishes.publish({});
    }
    held.lead(testing::wanted_in_V(leaning_path(), 1e-3 * tick));
    const testing::WantedInV wanted = testing::wanted_in_V(beside, 1e-3 * tick);
    hand.set_target(wanted.X_VD, wanted.v_V, 0);
    loops.tick();
    if (fault && tick >= kFaultTick && !held.motors().isZero(0)) ms_to_zero = tick - kFaultTick + 1;
  }
  if (fault) {
    EXPECT_TRUE(on) << fault->name << ": no contact before";
    EXPECT_LE(ms_to_zero, fault->bound_ms) << fault->name;
    EXPECT_NE(std::find(fault->causes.begin(), fault->causes.end(), loops.cause(0)),
              fault->causes.end())
        << fault->name << ": " << describe(loops.cause(0));
    EXPECT_EQ(loops.cause(1), ForceOff::kNone) << fault->name;
  }
  return other.forces_V;
}

// To the bit: the fault of one hand is its own.
template <class Led, class Faults, class Make>
void expect_other_untouched(const Make& make, const Faults& faults) {
  const std::vector<Vec3> sound = felt_beside(make()->held(), nullptr);
  ASSERT_GT(sound.back().norm(), 0.5);
  const std::size_t count = faults(*make()).size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::unique_ptr<Led> led = make();
    const Fault fault = faults(*led)[i];
    EXPECT_EQ(felt_beside(led->held(), &fault), sound) << fault.name;
  }
}

TEST(FaultOfOneHand, APhantomArmsLeavesTheOtherHandsForceAsItWas) {
  expect_other_untouched<LedArm>([] { return std::make_unique<LedArm>(); },
                                 [](LedArm& arm) { return faults_of(arm); });
}

TEST_F(FaultRecording, OfAPhantomArm) {
  const std::size_t count = faults_of(*std::make_unique<LedArm>()).size();
  for (std::size_t i = 0; i < count; ++i) {
    LedArm arm;
    expect_all_is_kept(arm.held(), faults_of(arm)[i]);
  }
}

// A joystick in a hand that may be torn aside.
struct LedJoystick {
  explicit LedJoystick(const testing::JoystickKind& kind) : rig(kind) {
    lead(testing::wanted_in_V(leaning_path(), 0));
    rig.open();
  }
  void lead(const testing::WantedInV& wanted) {
    Pose to = wanted.X_VD;
    if (torn) to.p += Vec3(-0.075, 0.07, 0);
    rig.mechanics->set_target(to, torn ? Vec3(-5, 5, 0) : wanted.v_V, 0);
    rig.pass_ms(1);
  }
  Held held() {
    return {*rig.device, [this](const testing::WantedInV& w) { lead(w); },
            [this] { return rig.motors(); }};
  }
  JoystickRig rig;
  bool torn = false;
};

// What every joystick may suffer.
std::vector<Fault> faults_of(LedJoystick& joystick) {
  JoystickRig& rig = joystick.rig;
  return {
      // Its own time-out ends the force: nothing reaches it any more.
      {"unplugged", {ForceOff::kDisconnect}, 21, [&] { rig.bus.detach(rig.port); }},
      {"silent for 100 ms",
       {ForceOff::kDisconnect},
       21,
       [&] { rig.faults().silent_until_ns = rig.bus.now_ns() + 100 * kMs; }},
      {"the program stalls for 100 ms", {ForceOff::kWatchdog}, 2, [&] { rig.pass_ms(100); }},
      {"late",
       {ForceOff::kDisconnect},
       15,
       [&] { rig.faults().in_late_ns = 50 * kMs; },
       [&] { rig.faults().in_late_ns = 0; }},
      // A random packet may look sound and leap: then the hand seems too fast.
      {"garbage",
       {ForceOff::kDeviceFault, ForceOff::kVelocity},
       15,
       [&] { rig.faults().garbage_in = 100; }},
      {"short reports", {ForceOff::kDeviceFault}, 15, [&] { rig.faults().short_in = 100; }},
      {"STALL of IN", {ForceOff::kDeviceFault}, 5, [&] { rig.faults().stall_in = true; }},
      {"STALL of OUT", {ForceOff::kDeviceFault}, 21, [&] { rig.faults().stall_out = true; }},
      {"over-velocity",
       {ForceOff::kVelocity},
       100,
       [&] { joystick.torn = true; },
       [&] { joystick.torn = false; }},
      not_a_number(5),
      {"closed", {ForceOff::kDisconnect}, 0, [&] { rig.device->close(); }},
  };
}

// What it tells of itself, as far as its dialect can.
std::vector<Fault> told_by(JoystickRig& rig) {
  const auto bit = [&](std::uint8_t which, bool value) {
    return [&rig, which, value] { rig.vector->set_status_bit(which, value); };
  };
  if (rig.vector)
    return {{"over-temperature",
             {ForceOff::kTemperature},
             5,
             bit(VectorState::kTooWarm, true),
             bit(VectorState::kTooWarm, false)},
            {"lost calibration",
             {ForceOff::kCalibration},
             5,
             bit(VectorState::kHomed, false),
             bit(VectorState::kHomed, true)},
            {"its own fault",
             {ForceOff::kDeviceFault},
             5,
             bit(VectorState::kFault, true),
             bit(VectorState::kFault, false)},
            {"let go",
             {ForceOff::kDeadMan},
             5,
             bit(VectorState::kDeadManOpen, true),
             bit(VectorState::kDeadManOpen, false)}};
  return {{"its supply fails",
           {ForceOff::kDeviceFault},
           5,
           [&] { rig.pid->set_switches(true, false); },
           [&] { rig.pid->set_switches(true, true); }},
          {"let go",
           {ForceOff::kDeadMan},
           5,
           [&] { rig.pid->set_switches(false, true); },
           [&] { rig.pid->set_switches(true, true); }}};
}

TEST(FaultOfOneHand, AJoysticksLeavesTheOtherHandsForceAsItWas) {
  for (const testing::JoystickKind& kind :
       {testing::kVectorKind, testing::kPidKind, testing::kPidByControlKind})
    expect_other_untouched<LedJoystick>([&] { return std::make_unique<LedJoystick>(kind); },
                                        [](LedJoystick& joystick) {
                                          std::vector<Fault> all = faults_of(joystick);
                                          for (Fault& fault : told_by(joystick.rig))
                                            all.push_back(std::move(fault));
                                          return all;
                                        });
}

void FaultRecording::try_joystick(const testing::JoystickKind& kind) {
  const auto all = [](LedJoystick& joystick) {
    std::vector<Fault> faults = faults_of(joystick);
    for (Fault& fault : told_by(joystick.rig)) faults.push_back(std::move(fault));
    return faults;
  };
  const std::size_t count = all(*std::make_unique<LedJoystick>(kind)).size();
  for (std::size_t i = 0; i < count; ++i) {
    LedJoystick joystick(kind);
    expect_all_is_kept(joystick.held(), all(joystick)[i]);
  }
}

TEST_F(FaultRecording, OfAVectorJoystick) { try_joystick(testing::kVectorKind); }
TEST_F(FaultRecording, OfAPidJoystick) { try_joystick(testing::kPidKind); }
TEST_F(FaultRecording, OfAPidJoystickWithoutOutEndpoint) {
  try_joystick(testing::kPidByControlKind);
}

// A homed Falcon in a hand that may be torn aside.
struct LedFalcon {
  LedFalcon() {
    rig.home(*device);
    rig.lead(*device, testing::wanted_in_V(leaning_path(), 0).X_VD.p, 300);
  }
  void lead(const testing::WantedInV& wanted) {
    rig.falcon->want(wanted.X_VD.p, torn ? Vec3(40, 0, 0) : wanted.v_V);
    rig.step();
  }
  Held held() {
    return {*device, [this](const testing::WantedInV& w) { lead(w); },
            [this] { return rig.falcon->motor_force(); }};
  }
  testing::FalconRig rig;
  std::unique_ptr<HapticDevice> device = rig.open();
  bool torn = false;
};

std::vector<Fault> faults_of(LedFalcon& held) {
  testing::FalconRig& rig = held.rig;
  UsbFaults& faults = rig.bus.faults(rig.port);
  return {
      {"unplugged", {ForceOff::kDisconnect}, 2, [&] { rig.bus.detach(rig.port); }},
      // Nothing can reach it before it listens again.
      {"silent for 100 ms",
       {ForceOff::kDisconnect},
       103,
       [&] { faults.silent_until_ns = rig.bus.now_ns() + 100 * kMs; }},
      {"the program stalls for 100 ms", {ForceOff::kWatchdog}, 2, [&] { rig.step(100); }},
      {"noise on the wire", {ForceOff::kDisconnect}, 14, [&] { faults.garbage_in = 40; }},
      {"readings of no position",
       {ForceOff::kDeviceFault},
       14,
       [&] { rig.falcon->nonsense = true; },
       [&] { rig.falcon->nonsense = false; }},
      {"short packets", {ForceOff::kDisconnect}, 14, [&] { faults.short_in = 40; }},
      {"late packets",
       {ForceOff::kDisconnect},
       14,
       [&] { faults.in_late_ns = 15 * kMs; },
       [&] { faults.in_late_ns = 0; }},
      {"STALL of IN", {ForceOff::kDeviceFault}, 3, [&] { faults.stall_in = true; }},
      {"STALL of OUT", {ForceOff::kDeviceFault}, 4, [&] { faults.stall_out = true; }},
      {"over-velocity",
       {ForceOff::kVelocity},
       40,
       [&] { held.torn = true; },
       [&] { held.torn = false; }},
      not_a_number(2),
      {"lost homing", {ForceOff::kCalibration}, 3, [&] { rig.falcon->lose_homing(); }},
      {"power lost", {ForceOff::kDisconnect}, 15, [&] { rig.falcon->switch_off_and_on(); }},
      {"closed", {ForceOff::kDisconnect}, 0, [&] { held.device->close(); }},
  };
}

TEST(FaultOfOneHand, AFalconsLeavesTheOtherHandsForceAsItWas) {
  expect_other_untouched<LedFalcon>([] { return std::make_unique<LedFalcon>(); },
                                    [](LedFalcon& falcon) { return faults_of(falcon); });
}

TEST_F(FaultRecording, OfAFalcon) {
  const std::size_t count = faults_of(*std::make_unique<LedFalcon>()).size();
  for (std::size_t i = 0; i < count; ++i) {
    LedFalcon falcon;
    expect_all_is_kept(falcon.held(), faults_of(falcon)[i]);
  }
}

}  // namespace
}  // namespace osteon
