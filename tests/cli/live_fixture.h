#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
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

/// Waits while files of a folder change.
class FolderWatch {
 public:
  explicit FolderWatch(const fs::path& folder) : fd_(::inotify_init1(IN_CLOEXEC)) {
    ::inotify_add_watch(fd_, folder.c_str(), IN_CREATE | IN_MODIFY | IN_MOVED_TO);
  }
  ~FolderWatch() { ::close(fd_); }
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// Asks again at every change; false after 10 000 changes, or half a minute without one.
  bool until(const std::function<bool()>& is_so) {
    for (int i = 0; i < 10000 && !is_so(); ++i) {
      pollfd change{fd_, POLLIN, 0};
      std::array<char, 4096> names;
      if (::poll(&change, 1, 30000) != 1 || ::read(fd_, names.data(), names.size()) <= 0) break;
    }
    return is_so();
  }

 private:
  int fd_;
};

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

  // Until the device is open and the loops are on.
  bool wait_until_running() {
    return FolderWatch(dir_).until([this] {
      const bool told = output().find("Force is on") != std::string::npos;
      // The window opens the device, and once more when it begins to record.
      return told || (fs::exists(file("force.csv")) && fs::exists(file("run.osr")));
    });
  }

  // Begins a run and gives its process.
  using Start = std::function<pid_t()>;

  // `number` 0: it ends by itself.
  void expect_orderly_end(const Start& start, int number) {
    expect_orderly_end(start, number == 0 ? 0 : 128 + number, [this, number](pid_t child) {
      if (number == 0) return;
      wait_for_contact();
      ::kill(child, number);
    });
  }

  // Until the recording has so many ticks that the hand has long come down onto the block.
  void wait_for_contact() {
    const bool recorded = FolderWatch(dir_).until([this] {
      const auto so_far = load_recording(file("run.osr"));
      return so_far && so_far->ticks.size() > 2000;
    });
    EXPECT_TRUE(recorded) << output();
  }

  // Every run must end in order, and one of them out of a press that lasted until the end: on a
  // busy machine the watchdog may have ended the force before.
  void expect_orderly_end(const Start& start, int exit_code,
                          const std::function<void(pid_t)>& end) {
    std::string why;
    for (int attempt = 0; attempt < 4; ++attempt) {
      expect_one_orderly_end(start(), exit_code, end, why);
      if (why.empty() || HasFailure()) return;
      std::printf("run %d: %s\n", attempt + 1, why.c_str());
    }
    ADD_FAILURE() << "in no run the press lasted until the end; in the last: " << why;
  }

  void expect_one_orderly_end(pid_t child, int exit_code, const std::function<void(pid_t)>& end,
                              std::string& why) {
    ASSERT_TRUE(wait_until_running()) << output();
    end(child);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "killed by " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), exit_code) << output();
    expect_zero_after_contact(why);
    const auto recording = load_recording(file("run.osr"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->complete);
    const Ran replayed = run_osteon("replay " + file("run.osr"));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
    fs::remove(file("run.osr"));
    fs::remove(file("out.txt"));
  }

  // The device was left at zero and closed; `why` it was not pressed to the last, or nothing.
  void expect_zero_after_contact(std::string& why) {
    const ForceLog log = read_log(file("force.csv"));
    fs::remove(file("force.csv"));
    ASSERT_GT(log.forces_n.size(), 500u) << output();
    EXPECT_EQ(log.forces_n.back(), 0);
    EXPECT_TRUE(log.closed);
    why = why_not_pressed_to_the_last(log);
    if (!why.empty()) why += held_up(log) + "\n" + output();
  }

  // To the last: the force went from a press to nothing, within a tick.
  static std::string why_not_pressed_to_the_last(const ForceLog& log) {
    const auto last_felt = std::find_if(log.forces_n.rbegin(), log.forces_n.rend(),
                                        [](double force) { return force > 0; });
    if (last_felt == log.forces_n.rend()) return "never felt anything";
    if (*last_felt <= 0.3) return "ended in " + std::to_string(*last_felt) + " N";
    const auto zeros = last_felt - log.forces_n.rbegin();
    // The zeros of the loop, of stop and of close.
    return zeros <= 4 ? "" : "was without force for " + std::to_string(zeros) + " ticks";
  }

  static std::string held_up(const ForceLog& log) {
    return "; the longest tick took " + std::to_string(1e3 * log.longest_gap_s) + " ms";
  }
};

}  // namespace osteon::testing_cli
