// The real program with an emulated user in contact, ended by signals.
#include "live_fixture.h"

namespace osteon::testing_cli {
namespace {

class LiveSignal : public LiveFixture {
 protected:
  Start start(const std::string& extra = "") {
    return [=, this] {
      return start_shell(std::string("exec ") + OSTEON_EXECUTABLE + " live" + run_options() +
                         extra);
    };
  }
};

TEST_F(LiveSignal, TerminateInContactLeavesZeroForceAClosedDeviceAndAWholeRecording) {
  expect_orderly_end(start(), SIGTERM);
}

TEST_F(LiveSignal, InterruptAndHangUpDoTheSame) {
  expect_orderly_end(start(), SIGINT);
  expect_orderly_end(start(), SIGHUP);
}

TEST_F(LiveSignal, SoDoTheEmulatedJoysticks) {
  expect_orderly_end(start("--device virtual-usb-vector"), SIGTERM);
  expect_orderly_end(start("--device virtual-usb-pid"), SIGTERM);
}

TEST_F(LiveSignal, TwoHandsRunInOneWorld) {
  const Ran ran =
      run_osteon("live --device virtual --device virtual --seconds 2 --path " + file("press.csv") +
                 " --case " + file("case") + " --record " + file("two.osr"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Ran replayed = run_osteon("replay " + file("two.osr"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  const Ran info = run_osteon("record info " + file("two.osr"));
  EXPECT_NE(info.output.find("left"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("right"), std::string::npos) << info.output;
}

TEST_F(LiveSignal, ADeviceThatIsNotThereIsSaidSo) {
  const Ran ran = run_osteon("live --device joystick9 --case " + file("case"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("osteon devices"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
