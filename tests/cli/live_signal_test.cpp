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

// What the loops cut in real time is in the recording: it replays with the same bits, and the bone
// that is saved out of it has the hole.
TEST_F(LiveSignal, ADrillCarvesAndItsRecordingReplays) {
  fs::create_directories(dir_ / "small");
  const Ran made = make_block_case(dir_ / "small", 5);
  ASSERT_EQ(made.exit_code, 0) << made.output;
  std::ofstream(file("drill.csv"))
      << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
         "0,0,0,5.5,1,0,0,0,0,drill,2,1,0\n0.2,0,0,1,1,0,0,0,0,drill,2,1,0\n"
         "60,0,0,1,1,0,0,0,0,drill,2,1,0\n";
  const std::string the_case = file("small/case") + "#block=field";
  const Ran ran = run_osteon("live --device virtual --seconds 1.5 --path " + file("drill.csv") +
                             " --case '" + the_case + "' --record " + file("drilled.osr"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_NE(ran.output.find("begins to cut block"), std::string::npos) << ran.output;
  const Ran replayed = run_osteon("replay " + file("drilled.osr"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  const Ran saved =
      run_osteon("case save " + file("drilled.osr") + " --at 1.2 --out " + file("saved"));
  EXPECT_EQ(saved.exit_code, 0) << saved.output;
  EXPECT_NE(saved.output.find("1 carved bone"), std::string::npos) << saved.output;
}

TEST_F(LiveSignal, ADeviceThatIsNotThereIsSaidSo) {
  const Ran ran = run_osteon("live --device joystick9 --case " + file("case"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("osteon devices"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
