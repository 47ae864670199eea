// A device that is lost in contact ends the force and nothing else: the run goes on, and what is
// recorded of it is whole and repeats to the bit.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "device/falcon/falcon_rig.h"
#include "device/joystick/joystick_rig.h"
#include "device/phantom/stub_library.h"
#include "drivers/run_loop.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

using testing::RunLoop;

constexpr double kLost_s = 1.4;  // of the path: leaning on the block

// What one run left.
struct Left {
  std::uint64_t ticks = 0;
  double force_before_n = 0;  ///< at the motors when the device was lost
  int ms_to_zero = 0;
  ForceOff cause = ForceOff::kNone;
};

// `lead(t)` moves the hand and the world by 1 ms, `lose()` takes the device away.
Left run(HapticDevice& device, RecordFeed& feed, const std::function<void(double)>& lead,
         const std::function<void()>& lose, const std::function<Vec3()>& motors) {
  RunLoop loop(test::blocks_case(), device, testing::turned_mapping(), 1, true, &feed);
  Left left;
  bool lost = false;
  for (double t = 0; t < testing::press_and_slide_path().duration_s(); t += 0.001) {
    if (t >= kLost_s && !lost) {
      left.force_before_n = motors().norm();
      lose();
      lost = true;
    }
    lead(t);
    loop.tick();
    ++left.ticks;
    (void)feed.drain();
    if (lost && !motors().isZero(0)) ++left.ms_to_zero;
  }
  left.cause = loop.status().cause;
  return left;
}

class FaultRecording : public ::testing::Test {
 protected:
  FaultRecording()
      : file_(std::filesystem::path(::testing::TempDir()) /
              ("fault_recording_" + std::to_string(::getpid()) + ".osr")) {
    std::filesystem::remove(file_);
    auto writer = RecordingWriter::create(
        file_, recording_header(*test::blocks_case(), RunLoop::settings(), "blocks", "test"));
    EXPECT_TRUE(writer) << writer.error().message();
    feed_ = std::make_unique<RecordFeed>(std::move(*writer));
  }
  ~FaultRecording() override { std::filesystem::remove(file_); }

  // `bound_ms`: until the motors are at zero.
  void expect_all_is_kept(const Left& left, int bound_ms = 2) {
    EXPECT_GT(left.force_before_n, 0.5) << "no contact";
    EXPECT_LE(left.ms_to_zero, bound_ms);
    EXPECT_EQ(left.cause, ForceOff::kDisconnect) << describe(left.cause);
    ASSERT_TRUE(feed_->finish());
    const auto recording = load_recording(file_);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->complete);
    const auto replayed = replay(*recording, test::blocks_case());
    ASSERT_TRUE(replayed) << replayed.error().message();
    EXPECT_TRUE(replayed->identical) << "at tick " << replayed->first_different_tick;
    EXPECT_EQ(replayed->ticks, left.ticks);
  }

  void unplug(const testing::JoystickKind& kind) {
    testing::JoystickRig rig(kind);
    const ProbePath path = testing::press_and_slide_path();
    const auto lead = [&](double t) {
      const testing::WantedInV wanted = testing::wanted_in_V(path, t);
      rig.mechanics->set_target(wanted.X_VD, wanted.v_V, 0);
      rig.pass_ms(1);
    };
    lead(0);
    rig.open();
    expect_all_is_kept(run(
                           *rig.device, *feed_, lead, [&] { rig.bus.detach(rig.port); },
                           [&] { return rig.motors(); }),
                       21);
  }

  std::filesystem::path file_;
  std::unique_ptr<RecordFeed> feed_;
};

TEST_F(FaultRecording, OfAPhantomArmThatIsUnplugged) {
  testing::StubLibrary stub;
  const ProbePath path = testing::press_and_slide_path();
  const auto lead = [&](double t) {
    const testing::WantedInV wanted = testing::wanted_in_V(path, t);
    testing::want(*stub.left, 1000 * wanted.X_VD.p + Vec3(0, 50, -30), 1000 * wanted.v_V);
    stub.step(1);
  };
  lead(0);
  const auto arm = PhantomDevice::open(stub.session(), "Left Device").value();
  expect_all_is_kept(run(
      *arm, *feed_, lead, [&] { stub.left->plugged = false; },
      [&] { return testing::motor_force(*stub.left); }));
}

// Its own time-out ends the force: nothing reaches it any more.
TEST_F(FaultRecording, OfAVectorJoystickThatIsUnplugged) { unplug(testing::kVectorKind); }
TEST_F(FaultRecording, OfAPidJoystickThatIsUnplugged) { unplug(testing::kPidKind); }
TEST_F(FaultRecording, OfAPidJoystickWithoutOutEndpointThatIsUnplugged) {
  unplug(testing::kPidByControlKind);
}

TEST_F(FaultRecording, OfAFalconThatIsUnplugged) {
  testing::FalconRig rig;
  const ProbePath path = testing::press_and_slide_path();
  const auto device = rig.open();
  rig.home(*device);
  rig.lead(*device, testing::wanted_in_V(path, 0).X_VD.p, 300);
  const auto lead = [&](double t) {
    const testing::WantedInV wanted = testing::wanted_in_V(path, t);
    rig.falcon->want(wanted.X_VD.p, wanted.v_V);
    rig.step();
  };
  expect_all_is_kept(run(
      *device, *feed_, lead, [&] { rig.bus.detach(rig.port); },
      [&] { return rig.falcon->motor_force(); }));
}

}  // namespace
}  // namespace osteon
