// Exercises that a virtual surgeon plays on devices in real time.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <sstream>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class LiveExercise : public CliTest {
 protected:
  // The probing exercise, which ends after so many seconds whatever was done.
  std::string short_exercise(int seconds) const {
    std::ifstream in(fs::path(OSTEON_SOURCE_DIR) / "assets" / "scenarios" / "fast_probing.toml");
    std::stringstream all;
    all << in.rdbuf();
    std::string text = all.str();
    const auto at = text.find("time_limit_s = ");
    EXPECT_NE(at, std::string::npos);
    text.replace(at, text.find('\n', at) - at, "time_limit_s = " + std::to_string(seconds));
    std::ofstream(file("short.toml")) << text;
    return file("short.toml");
  }
  void expect_refused(const std::string& options, const std::string& words) const {
    const Ran ran = run_osteon("run fast_probing --no-store " + options);
    EXPECT_EQ(ran.exit_code, 2) << options;
    EXPECT_NE(ran.output.find(words), std::string::npos) << ran.output;
  }
};

TEST_F(LiveExercise, SaysWhatItCannotBePlayedOn) {
  expect_refused("--live", "a live run needs devices");
  expect_refused("--live --device virtual", "needs both hands at once");
  expect_refused("--live --device virtual --device virtual --device virtual",
                 "there are more devices");
  expect_refused("--live --device virtual --device mouse", "held by a real hand");
  expect_refused("--live --device virtual=hook_probe --device virtual", "told by the exercise");
  expect_refused("--live --device virtual --device nothing", "there is no such device");
  expect_refused("--device virtual --device virtual", "Add --live");
}

TEST_F(LiveExercise, PlaysOnTwoDevicesAndWhatItRecordsRepeats) {
  const Ran ran = run_osteon("run " + short_exercise(3) +
                             " --live --device virtual --device virtual-usb-vector --no-store "
                             "--record " +
                             file("run.osr") + " --report " + file("report.json"));
  // Nobody is done in three seconds.
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_NE(ran.output.find("not_passed"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("scope (virtual-usb-vector): "), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("p99.9"), std::string::npos) << ran.output;
  EXPECT_TRUE(fs::exists(file("report.json")));
  const Ran replayed = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  const Ran judged = run_osteon("debrief " + file("run.osr") + " --out " + file("page.pdf"));
  EXPECT_EQ(judged.exit_code, 0) << judged.output;
}

TEST_F(LiveExercise, EndsInOrderByASignal) {
  const std::string out = file("out.txt");
  const Ran ran = run_osteon(
      "run fast_probing --live --device virtual --device virtual --no-store "
      "--record " +
      file("run.osr") + " > " + out +
      " 2>&1 & pid=$!; n=0; while [ $(stat -c "
      "%s " +
      file("run.osr") +
      " 2>/dev/null || echo 0) -lt 20000 ] && [ $n "
      "-lt 600 ]; do sleep 0.1; n=$((n+1)); done; kill -TERM $pid; wait $pid; "
      "code=$?; cat " +
      out + "; exit $code");
  EXPECT_EQ(ran.exit_code, 128 + SIGTERM) << ran.output;
  EXPECT_NE(ran.output.find("not_passed"), std::string::npos) << ran.output;
  const Ran replayed = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
}

}  // namespace
}  // namespace osteon::testing_cli
