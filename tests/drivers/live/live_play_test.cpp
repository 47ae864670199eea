// A virtual surgeon plays exercises by PHANToM arms: the vendor's library is the tests' stand-in,
// everything from the driver upwards is the program's own.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <system_error>
#include <utility>

#include "commands/teaching/scenario_run.h"
#include "device/phantom/stub_library.h"
#include "exercises/debrief.h"
#include "exercises/scenario_files.h"
#include "osteon/base/clock.h"
#include "osteon/device/emulated_user.h"
#include "osteon/surgeon/skill.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using testing::StubLibrary;

const Vec3 kMiddle_mm(0, 50, -30);  // of the stand-in's usable workspace

// An arm by the program's driver, with the hand on it.
class ArmInHand : public HapticDevice, public EmulatedUser {
 public:
  ArmInHand(StubLibrary& stub, StubArm* arm, const std::shared_ptr<HdSession>& session,
            const char* name)
      : stub_(stub), arm_(arm), device_(PhantomDevice::open(session, name).value()) {}
  void set_target(const Pose& X_VD, const Vec3& v_V, std::uint32_t) override {
    const Vec3 p_mm = 1000 * X_VD.p + kMiddle_mm, v_mm = 1000 * v_V;
    const double q[4] = {X_VD.q.w(), X_VD.q.x(), X_VD.q.y(), X_VD.q.z()};
    stub_.want(arm_, p_mm.data(), q, v_mm.data());
  }
  const DeviceInfo& info() const override { return device_->info(); }
  DeviceSample read() override {
    if (++reads_ == unplug_at) stub_.plug(arm_, false);
    return device_->read();
  }
  void write_force(const Vec3& force_V) override { device_->write_force(force_V); }
  void close() override { device_->close(); }
  DeviceHealth health() const override { return device_->health(); }
  void calibrate() override { device_->calibrate(); }

  std::uint64_t unplug_at = 0;  ///< reading; 0: never

 private:
  StubLibrary& stub_;
  StubArm* arm_;
  std::unique_ptr<HapticDevice> device_;
  std::uint64_t reads_ = 0;
};

class LivePlay : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon-live-play-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    for (StubArm* arm : {stub_.left, stub_.right}) {
      arm->model = "PHANTOM Premium 1.5";
      arm->max_force_n = 8.5;
      arm->max_stiffness_n_per_mm = 3.5;
    }
  }
  void TearDown() override {
    std::error_code gone;
    fs::remove_all(folder_, gone);
    unsetenv("STUB_HD_THREAD");
  }

  ScenarioRun order(const char* name, std::uint64_t seed) {
    ScenarioRun run;
    run.scenario = open_scenario(name).value();
    run.standard = shipped_standard(run.scenario.name).value();
    run.skill = parse_skill(run.scenario, "expert").value();
    run.case_spec = case_spec_of(run.scenario, "", seed);
    run.record_to = folder_ / "run.osr";
    return run;
  }
  void give_arms(ScenarioRun& run, int arms, bool by_threads, std::uint64_t unplug_at = 0) {
    if (by_threads) setenv("STUB_HD_THREAD", "1", 1);
    const auto session =
        std::make_shared<HdSession>(stub_.api, by_threads ? steady_now_ns : stub_.now_ns);
    run.live = std::make_shared<std::vector<LedDevice>>();
    for (int i = 0; i < arms; ++i) {
      StubArm* arm = i == 0 ? stub_.left : stub_.right;
      const char* name = i == 0 ? "Left Device" : "Right Device";
      auto held = std::make_unique<ArmInHand>(stub_, arm, session, name);
      if (i == 0) held->unplug_at = unplug_at;
      run.live->push_back({name, std::move(held)});
    }
    if (!by_threads) run.step_devices = [this] { stub_.step(1); };
  }
  static void print(const ScenarioOutcome& done) {
    std::printf("%s%s", to_text(done.outcome).c_str(), to_text(*done.live).c_str());
    std::fflush(stdout);
  }
  static void expect_passed(const Result<ScenarioOutcome>& done) {
    ASSERT_TRUE(done) << done.error().message();
    print(*done);
    EXPECT_EQ(done->live->broken_off, "");
    EXPECT_EQ(done->outcome.verdict, Verdict::kPassed);
    EXPECT_TRUE(done->outcome.errors.empty());
    EXPECT_TRUE(done->identical);
  }
  // Nobody may be left with a force, and the library was used by its rules.
  void expect_orderly_end() {
    for (const StubArm* arm : {stub_.left, stub_.right}) {
      EXPECT_EQ(testing::motor_force(*arm).norm(), 0);
      EXPECT_FALSE(arm->open);
    }
    EXPECT_EQ(stub_.misuses(), 0u);
  }

  StubLibrary stub_;
  fs::path folder_;
};

TEST_F(LivePlay, TwoArmsPlayAnExerciseForTwoHands) {
  ScenarioRun run = order("fast_probing", 1);
  give_arms(run, 2, false);
  expect_passed(run_scenario(run));
  EXPECT_GT(stub_.left->peak_motor_n, 0.3);
  expect_orderly_end();
}

TEST_F(LivePlay, AnArmThatIsUnpluggedBreaksItOffAtZeroForce) {
  ScenarioRun run = order("fast_probing", 1);
  give_arms(run, 2, false, 8000);
  const auto done = run_scenario(run);
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_NE(done->live->broken_off.find("Left Device"), std::string::npos)
      << done->live->broken_off;
  EXPECT_GT(done->live->duration_s, 7.5);
  EXPECT_LT(done->live->duration_s, 8.5);
  EXPECT_EQ(done->outcome.verdict, Verdict::kNotPassed);
  EXPECT_TRUE(done->identical);
  expect_orderly_end();
  // What was done up to then is kept.
  const auto kept = make_debrief({*run.record_to, "", "", ""});
  ASSERT_TRUE(kept) << kept.error().message();
  EXPECT_EQ(kept->surgeon, "expert");
  EXPECT_GT(kept->duration_s, 7.5);
}

TEST_F(LivePlay, ThePinAndTheProbeTakeTurnsAtOneArm) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "OSTEON_LONG=1 plays a whole reconstruction";
  ScenarioRun run = order("acl", 0);
  give_arms(run, 2, false);
  expect_passed(run_scenario(run));
  expect_orderly_end();
}

TEST_F(LivePlay, TwoArmsPlayAReconstructionInRealTime) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "OSTEON_LONG=1 plays it, for eleven minutes";
  ScenarioRun run = order("acl", 0);
  give_arms(run, 2, true);
  expect_passed(run_scenario(run));
  expect_orderly_end();
}

}  // namespace
}  // namespace osteon
