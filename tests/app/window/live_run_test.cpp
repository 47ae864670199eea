#include "window/live_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "app/loops/fake_device.h"

namespace osteon {
namespace {

// Far from the blocks; after a second it leaps by 0.2 m, faster than any hand may move.
ProbePath leaping_path() {
  ProbePath path;
  for (const auto& [time_s, x] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.01, 0.2}, {9.0, 0.2}}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(x, 0, 0.1);
    path.samples.push_back(sample);
  }
  return path;
}

DeviceChoice virtual_hand() {
  const auto choices = list_device_choices(nullptr);
  return choices.at(static_cast<std::size_t>(find_choice(choices, "virtual")));
}

// The loops run in real time; how long they take does not matter.
template <class Until>
void run_until(LiveRun& live, Until until) {
  do {
    std::this_thread::yield();
    live.update();
  } while (!until());
}

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() : live(test::blocks_case(), "blocks", leaping_path(), {}) {
    EXPECT_TRUE(live.start(virtual_hand(), Pose{}));
  }
  ~LiveRunTest() override { std::filesystem::remove(file); }

  void run_until_it_trips() {
    run_until(live, [&] { return live.device_status().cause == ForceOff::kVelocity; });
  }
  // The first that the new run tells.
  ForceOff cause_of_next_run() {
    run_until(live, [&] { return live.snapshot().tool.tick < 900; });
    return live.device_status().cause;
  }

  LiveRun live;
  std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / ("live_" + std::to_string(::getpid()) + ".osr");
};

TEST_F(LiveRunTest, ARecordingThatBeginsAfterATripDoesNotArmTheForceAgain) {
  run_until_it_trips();
  ASSERT_TRUE(live.start_recording(file));
  EXPECT_EQ(cause_of_next_run(), ForceOff::kVelocity);
  live.set_force(true);
  run_until(live, [&] { return live.device_status().cause == ForceOff::kNone; });
  EXPECT_TRUE(live.stop_recording());
}

TEST_F(LiveRunTest, ALentDeviceComesBackToARunThatIsAsItWas) {
  EXPECT_TRUE(live.lend_device());
  EXPECT_FALSE(live.lend_device());
  EXPECT_FALSE(live.start_recording(file));
  live.update();  // stands still, harmlessly
  live.set_force(false);
  ASSERT_TRUE(live.take_back(nullptr));
  run_until(live, [&] { return live.snapshot().tool.tick > 8; });
  EXPECT_EQ(live.device_status().cause, ForceOff::kSoftware);
  live.set_force(true);
  run_until_it_trips();
  ASSERT_TRUE(live.take_back(live.lend_device()));
  EXPECT_EQ(cause_of_next_run(), ForceOff::kVelocity);
}

}  // namespace
}  // namespace osteon
