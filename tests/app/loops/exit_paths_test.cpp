// The program dies while an emulated joystick presses onto bone: whatever ends it, the haptic loop
// has time to leave the motors at zero. Each end is a process of its own.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <sstream>
#include <thread>
#include <utility>

#include "app/loops/fake_device.h"
#include "loops/device_log.h"
#include "loops/path_player.h"
#include "loops/runtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "osteon/device/drivers.h"

namespace osteon {
namespace {

/// One whose last words take long, as on a busy machine.
class SlowToClose : public HapticDevice {
 public:
  explicit SlowToClose(std::unique_ptr<HapticDevice> device) : device_(std::move(device)) {}
  const DeviceInfo& info() const override { return device_->info(); }
  DeviceSample read() override { return device_->read(); }
  void write_force(const Vec3& force_V) override { device_->write_force(force_V); }
  void close() override {
    constexpr std::int64_t kSlow_ns = 200'000'000;
    for (const std::int64_t begun_ns = steady_now_ns(); steady_now_ns() < begun_ns + kSlow_ns;) {
    }
    device_->close();
  }

 private:
  std::unique_ptr<HapticDevice> device_;
};

// Waits until the joystick presses with half a newton. A stall of a busy machine switches the force
// off, and it stays off until it is asked for again. False: it never pressed.
bool wait_until_pressed(Runtime& runtime) {
  constexpr std::int64_t kLongest_ns = 60'000'000'000;
  const std::int64_t begun_ns = steady_now_ns();
  while (runtime.device_status().force_at_hand_V.norm() < 0.5) {
    if (steady_now_ns() - begun_ns > kLongest_ns) return false;
    if (runtime.device_status().cause != ForceOff::kNone) runtime.set_force_enabled(true);
    std::this_thread::yield();
  }
  return true;
}

// Runs until the joystick presses with half a newton, then ends the program so.
void press_and(const std::function<void()>& end, const std::filesystem::path& log_file,
               bool slow_to_close = false) {
  const StopSignals signals;
  auto joystick = open_device("virtual-usb-vector");
  if (!joystick) std::_Exit(3);
  auto played = PathPlayer::make(std::move(*joystick), test::pressing_path());
  if (!played) std::_Exit(3);
  std::unique_ptr<HapticDevice> device = std::move(*played);
  if (slow_to_close) device = std::make_unique<SlowToClose>(std::move(device));
  constexpr double kLogged_s = 2;  // it is written while the program dies
  RunPlan plan;
  plan.the_case = test::blocks_case();
  Runtime runtime(plan, std::make_unique<DeviceLog>(std::move(device), kLogged_s, log_file));
  runtime.start();
  if (!wait_until_pressed(runtime)) {
    std::fprintf(stderr, "never pressed: %s\n", describe(runtime.device_status().cause));
    std::_Exit(5);
  }
  end();
  std::_Exit(4);  // it should not have come back
}

// Force of the last line that holds one, and of the last that was felt; -1: there is none.
struct LastForces {
  double last_n = -1, felt_n = -1;
  bool closed = false;
};

LastForces read_log(const std::filesystem::path& file) {
  LastForces forces;
  std::istringstream in(read_file(file).value_or(""));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    if (line == "closed") {
      forces.closed = true;
      continue;
    }
    double v[7] = {};
    std::istringstream fields(line);
    std::string field;
    for (int i = 0; i < 7 && std::getline(fields, field, ','); ++i) v[i] = std::stod(field);
    forces.last_n = std::hypot(v[4], v[5], v[6]);
    if (forces.last_n > 0) forces.felt_n = forces.last_n;
  }
  return forces;
}

class ExitPaths : public ::testing::Test {
 protected:
  // The child runs the test anew from its start: the name must be the same there.
  ExitPaths() {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    const char* given = std::getenv("OSTEON_EXIT_LOG");
    file = given ? given
                 : (std::filesystem::path(::testing::TempDir()) /
                    ("osteon_exit_" + std::to_string(::getpid()) + ".csv"))
                       .string();
    ::setenv("OSTEON_EXIT_LOG", file.c_str(), 1);
  }
  ~ExitPaths() override {
    ::unsetenv("OSTEON_EXIT_LOG");
    std::filesystem::remove(file);
  }
  void expect_zero_at_the_end() {
    const LastForces forces = read_log(file);
    EXPECT_GT(forces.felt_n, 0.4) << "never pressed";
    EXPECT_EQ(forces.last_n, 0);
    EXPECT_TRUE(forces.closed);
  }

  std::string file;
};

TEST_F(ExitPaths, ByTerminate) {
  EXPECT_EXIT(press_and([] { std::terminate(); }, file), ::testing::KilledBySignal(SIGABRT), "");
  expect_zero_at_the_end();
}

TEST_F(ExitPaths, ByAnExceptionThatNobodyCatches) {
  const auto thrown = [] { std::thread([] { throw std::bad_alloc(); }).join(); };
  EXPECT_EXIT(press_and(thrown, file), ::testing::KilledBySignal(SIGABRT), "");
  expect_zero_at_the_end();
}

TEST_F(ExitPaths, ByAbort) {
  EXPECT_EXIT(press_and([] { std::abort(); }, file), ::testing::KilledBySignal(SIGABRT), "");
  expect_zero_at_the_end();
}

TEST_F(ExitPaths, ADeviceThatIsSlowToCloseIsWaitedFor) {
  const auto abort = [] { std::abort(); };
  EXPECT_EXIT(press_and(abort, file, true), ::testing::KilledBySignal(SIGABRT), "");
  expect_zero_at_the_end();
}

TEST_F(ExitPaths, ByACrashBesideTheHapticLoop) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer takes the signal";
#endif
  EXPECT_EXIT(press_and([] { ::raise(SIGSEGV); }, file), ::testing::KilledBySignal(SIGSEGV), "");
  expect_zero_at_the_end();
}

}  // namespace
}  // namespace osteon
