#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "block_case.h"
#include "osteon/record/recording.h"

namespace osteon::testing_cli {

/// What a device was told in the last seconds of a run.
struct ForceLog {
  std::vector<double> forces_n;
  double longest_gap_s = 0;  ///< between two writes
  bool closed = false;
};

inline ForceLog read_log(const std::string& file) {
  ForceLog log;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  double last_s = 0;
  while (std::getline(in, line)) {
    if (line == "closed") {
      log.closed = true;
      continue;
    }
    double v[7] = {};
    std::stringstream fields(line);
    std::string field;
    for (int i = 0; i < 7 && std::getline(fields, field, ','); ++i) v[i] = std::stod(field);
    if (!log.forces_n.empty()) log.longest_gap_s = std::max(log.longest_gap_s, v[0] - last_s);
    last_s = v[0];
    log.forces_n.push_back(std::hypot(v[4], v[5], v[6]));
  }
  return log;
}

/// The real program with an emulated hand that presses a block, to be ended somehow.
class LiveFixture : public CliTest {
 protected:
  // A block of 40 mm with its top at z = 20, and a hand that comes down onto it and presses.
  void SetUp() override {
    CliTest::SetUp();
    std::ofstream(file("press.csv")) << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n"
                                        "0,0,0,24,1,0,0,0,0\n0.2,0,0,18,1,0,0,0,0\n"
                                        "60,0,0,18,1,0,0,0,0\n";
    const Ran made = make_block_case(dir_);
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }

  std::string run_options() const {
    return " --case " + file("case") + " --path " + file("press.csv") + " --record " +
           file("run.osr") + " --force-log " + file("force.csv") + " ";
  }

  pid_t start_shell(const std::string& command) {
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

  // Real time is what this is about: waits for the device to be open and the loops to be on.
  bool wait_until_running() {
    for (int i = 0; i < 600; ++i) {
      const bool told = output().find("Force is on") != std::string::npos;
      // The window opens the device, and once more when it begins to record.
      const bool records = fs::exists(file("force.csv")) && fs::exists(file("run.osr"));
      if (told || records) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  // `number` 0: it ends by itself.
  void expect_orderly_end(pid_t child, int number) {
    expect_orderly_end(child, number == 0 ? 0 : 128 + number, [&] {
      if (number == 0) return;
      wait_for_contact();
      ::kill(child, number);
    });
  }

  static void wait_for_contact() { std::this_thread::sleep_for(std::chrono::milliseconds(2500)); }

  void expect_orderly_end(pid_t child, int exit_code, const std::function<void()>& end) {
    ASSERT_TRUE(wait_until_running()) << output();
    end();
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "killed by " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), exit_code) << output();
    expect_zero_after_contact();
    const auto recording = load_recording(file("run.osr"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->complete);
    const Ran replayed = run_osteon("replay " + file("run.osr"));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
    fs::remove(file("run.osr"));
    fs::remove(file("out.txt"));
  }

  // In contact to the last: the force went from a press to nothing, within a tick.
  void expect_zero_after_contact() {
    const ForceLog log = read_log(file("force.csv"));
    ASSERT_GT(log.forces_n.size(), 500u) << output();
    EXPECT_EQ(log.forces_n.back(), 0);
    EXPECT_TRUE(log.closed);
    const auto last_felt = std::find_if(log.forces_n.rbegin(), log.forces_n.rend(),
                                        [](double force) { return force > 0; });
    fs::remove(file("force.csv"));
    if (log.longest_gap_s > 0.015) {
      std::printf("this machine held the loop up for %.0f ms: the force may have ended then\n",
                  1e3 * log.longest_gap_s);
      return;
    }
    ASSERT_NE(last_felt, log.forces_n.rend());
    EXPECT_GT(*last_felt, 0.3) << "never pressed: the test shows little";
    EXPECT_LE(last_felt - log.forces_n.rbegin(), 4);  // the zeros of the loop, of stop and of close
  }
};

}  // namespace osteon::testing_cli
