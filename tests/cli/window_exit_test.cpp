// The window with an emulated joystick in contact, ended by signals and by itself.
#include <signal.h>

#include "live_fixture.h"

namespace osteon::testing_cli {
namespace {

class WindowExit : public LiveFixture {
 protected:
  void SetUp() override {
    if (std::system("command -v Xvfb > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "Xvfb is not installed (Debian: xvfb)";
    LiveFixture::SetUp();
  }
  void TearDown() override {
    stop_display();
    LiveFixture::TearDown();
  }
  void stop_display() {
    std::ifstream in(file("xvfb.pid"));
    if (int display = 0; in >> display) ::kill(display, SIGTERM);
    for (const char* name : {"xvfb.pid", "display"}) fs::remove(file(name));
  }

  // A display of its own, and then the window in the shell's place: its process is the window's.
  Start start_window(const std::string& extra = "") {
    return [=, this] {
      stop_display();
      return start_shell(window_command(extra));
    };
  }

  std::string window_command(const std::string& extra) {
    return "Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3> " + file("display") +
           " 2> /dev/null & echo $! > " + file("xvfb.pid") + "; until [ -s " + file("display") +
           " ]; do sleep 0.05; done; export XDG_CONFIG_HOME=" + dir_.string() +
           " XDG_DATA_HOME=" + dir_.string() + " DISPLAY=:$(head -1 " + file("display") +
           "); exec " + OSTEON_EXECUTABLE + " window --device virtual-usb-vector --size 640x480" +
           run_options() + extra;
  }
};

TEST_F(WindowExit, ATerminationInContactLeavesZeroForceAClosedDeviceAndAWholeRecording) {
  expect_orderly_end(start_window(), SIGTERM);
}

TEST_F(WindowExit, AHangUpAndAnInterruptDoTheSame) {
  expect_orderly_end(start_window(), SIGHUP);
  expect_orderly_end(start_window(), SIGINT);
}

TEST_F(WindowExit, SoDoesTheKeyThatEndsIt) {
  if (std::system("command -v xdotool > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "xdotool is not installed (Debian: xdotool)";
  expect_orderly_end(start_window(), 0, [&](pid_t) {
    wait_for_contact();
    const std::string key = "DISPLAY=:$(head -1 " + file("display") + ") xdotool key ctrl+q";
    ASSERT_EQ(std::system(key.c_str()), 0);
  });
}

TEST_F(WindowExit, WithoutAnyDeviceLibraryItStartsAllTheSame) {
  ::setenv("OSTEON_HD_LIBRARY", file("no_such_libHD.so").c_str(), 1);
  expect_orderly_end(start_window(" --check-up --at 2 --frames 2"), 0);
  ::unsetenv("OSTEON_HD_LIBRARY");
}

TEST_F(WindowExit, SoDoesItsOwnEnd) { expect_orderly_end(start_window(" --at 2 --frames 2"), 0); }

}  // namespace
}  // namespace osteon::testing_cli
