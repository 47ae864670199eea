// The real program with an emulated user in contact, ended by signals.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

#include "osteon/record/recording.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

struct ForceLog {
  std::vector<double> forces_n;
  bool closed = false;
};

ForceLog read_log(const std::string& file) {
  ForceLog log;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    if (line == "closed") {
      log.closed = true;
      continue;
    }
    double v[7] = {};
    std::stringstream fields(line);
    std::string field;
    for (int i = 0; i < 7 && std::getline(fields, field, ','); ++i) v[i] = std::stod(field);
    log.forces_n.push_back(std::hypot(v[4], v[5], v[6]));
  }
  return log;
}

class LiveSignal : public CliTest {
 protected:
  // A block of 40 mm with its top at z = 20, and a hand that comes down onto it and presses.
  void SetUp() override {
    CliTest::SetUp();
    fs::create_directories(file("meshes"));
    std::ofstream block(file("meshes/block.obj"));
    for (int i = 0; i < 8; ++i)
      block << "v " << (i & 1 ? 20 : -20) << ' ' << (i & 2 ? 20 : -20) << ' ' << (i & 4 ? 20 : -20)
            << '\n';
    block << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
             "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
    block.close();
    std::ofstream(file("press.csv")) << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n"
                                        "0,0,0,24,1,0,0,0,0\n0.2,0,0,18,1,0,0,0,0\n"
                                        "60,0,0,18,1,0,0,0,0\n";
    const Ran made =
        run_osteon("import mesh " + file("meshes") + " --unit mm --out " + file("case"));
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }

  pid_t start(const std::string& extra = "") {
    const std::string command = std::string("exec ") + OSTEON_EXECUTABLE + " live --case " +
                                file("case") + " --path " + file("press.csv") + " --record " +
                                file("run.osr") + " --force-log " + file("force.csv") + " " + extra;
    const pid_t child = ::fork();
    if (child != 0) return child;
    const int out = ::open(file("out.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(out, 1);
    ::dup2(out, 2);
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }

  std::string output() {
    std::ifstream in(file("out.txt"));
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  // Real time is what this is about: waits for the loops to be on.
  bool wait_until_running() {
    for (int i = 0; i < 600; ++i) {
      if (output().find("Force is on") != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  void expect_orderly_end(pid_t child, int number) {
    ASSERT_TRUE(wait_until_running()) << output();
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    ::kill(child, number);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "killed by " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 128 + number) << output();
    const ForceLog log = read_log(file("force.csv"));
    ASSERT_GT(log.forces_n.size(), 1000u) << output();
    EXPECT_EQ(log.forces_n.back(), 0);
    EXPECT_TRUE(log.closed);
    // In contact to the last: the force went from a press to nothing, within a tick.
    const auto last_felt = std::find_if(log.forces_n.rbegin(), log.forces_n.rend(),
                                        [](double force) { return force > 0; });
    ASSERT_NE(last_felt, log.forces_n.rend());
    EXPECT_GT(*last_felt, 0.3) << "never pressed: the test shows little";
    EXPECT_LE(last_felt - log.forces_n.rbegin(), 4);  // the zeros of the loop, of stop and of close
    fs::remove(file("force.csv"));
    const auto recording = load_recording(file("run.osr"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->complete);
    const Ran replayed = run_osteon("replay " + file("run.osr"));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
    fs::remove(file("run.osr"));
    fs::remove(file("out.txt"));
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

TEST_F(LiveSignal, TwoHandsRunEachWithASessionOfItsOwn) {
  const Ran ran =
      run_osteon("live --device virtual --device virtual --seconds 2 --path " + file("press.csv") +
                 " --case " + file("case") + " --record " + file("two.osr"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  for (const char* name : {"two.osr", "two-2.osr"}) {
    const Ran replayed = run_osteon("replay " + file(name));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  }
}

TEST_F(LiveSignal, ADeviceThatIsNotThereIsSaidSo) {
  const Ran ran = run_osteon("live --device joystick9 --case " + file("case"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("osteon devices"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
