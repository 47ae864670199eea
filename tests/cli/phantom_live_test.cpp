// The real program with two PHANToM arms, through a stand-in for the vendor's library that runs a
// servo thread of its own and presses by itself; ended by a signal.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "block_case.h"

namespace osteon::testing_cli {
namespace {

class PhantomLive : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    const Ran made = make_block_case(dir_);
    ASSERT_EQ(made.exit_code, 0) << made.output;
    // The names that the vendor's set-up program would have left.
    fs::create_directories(file("config"));
    std::ofstream(file("config/Left Device.config")) << "\n";
    std::ofstream(file("config/Right Device.config")) << "\n";
    set("GTDD_HOME", dir_.string());
    set("OSTEON_HD_LIBRARY", STUB_HD);
    set("STUB_HD_THREAD", "1");
    set("STUB_HD_HAND", "press");
    set("STUB_HD_LOG", file("arms.txt"));
  }
  void TearDown() override {
    for (const std::string& name : set_) unsetenv(name.c_str());
    CliTest::TearDown();
  }
  void set(const std::string& name, const std::string& value) {
    setenv(name.c_str(), value.c_str(), 1);
    set_.push_back(name);
  }
  std::string text(const std::string& name) {
    std::ifstream in(file(name));
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  }

  // Both arms, three seconds from when the loops are on, then SIGTERM while they press.
  Ran run_both() {
    const std::string out = file("out.txt");
    fs::remove(out);
    return run_osteon("live --device \"phantom:Left Device\" --device \"phantom:Right Device\"" +
                      std::string(" --case ") + file("case") + " --record " + file("run.osr") +
                      " > " + out + " 2>&1 & pid=$!; n=0; while ! grep -q running " + out +
                      " && [ $n -lt 600 ]; do sleep 0.1; n=$((n+1)); done; sleep 3; " +
                      "kill -TERM $pid; wait $pid; code=$?; cat " + out + "; exit $code");
  }

  std::vector<std::string> set_;
};

TEST_F(PhantomLive, TwoArmsPressAndATerminationLeavesBothAtZero) {
  // On a machine that is busy enough the watchdog may end the force before the hands press; what is
  // left behind must be right whatever happened before.
  bool both_pressed = false;
  for (int attempt = 0; attempt < 4 && !both_pressed; ++attempt) {
    fs::remove(file("arms.txt"));
    fs::remove(file("run.osr"));
    const Ran ran = run_both();
    ASSERT_EQ(ran.exit_code, 128 + SIGTERM) << ran.output;
    std::istringstream arms(text("arms.txt"));
    int left = 0;
    int pressed = 0;
    for (std::string line; std::getline(arms, line); ++left) {
      EXPECT_NE(line.find("motors 0 N"), std::string::npos) << line;
      EXPECT_NE(line.find("last frame zero"), std::string::npos) << line;
      EXPECT_NE(line.find("misuses 0"), std::string::npos) << line;
      const auto at = line.find("peak ");
      ASSERT_NE(at, std::string::npos) << line;
      if (std::stod(line.substr(at + 5)) > 0.5) ++pressed;
    }
    EXPECT_EQ(left, 2) << ran.output;
    both_pressed = pressed == 2;
    const Ran replayed = run_osteon("replay " + file("run.osr"));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  }
  EXPECT_TRUE(both_pressed) << text("arms.txt");
}

TEST_F(PhantomLive, WithoutTheLibraryItSaysSo) {
  set("OSTEON_HD_LIBRARY", file("no_such_libHD.so"));
  const Ran ran = run_osteon("live --device phantom --case " + file("case"));
  EXPECT_NE(ran.exit_code, 0);
  EXPECT_NE(ran.output.find("phantom"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
