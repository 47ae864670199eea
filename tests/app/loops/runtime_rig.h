#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "app/loops/fake_device.h"
#include "loops/haptic_stage.h"
#include "loops/physics_stage.h"
#include "loops/runtime.h"

namespace osteon::test {

inline RunPlan plan_on(std::shared_ptr<const Case> the_case) {
  RunPlan plan;
  plan.the_case = std::move(the_case);
  return plan;
}

/// A file name in a fresh folder, removed with everything in it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const char* name) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("osteon-") + test->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / name;
  }
  ~TemporaryFile() {
    std::error_code ec;
    std::filesystem::remove_all(folder_, ec);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path folder_, path_;
};

inline std::unique_ptr<RecordFeed> feed_to(const std::filesystem::path& file, const RunPlan& plan,
                                           double seconds = 8.0) {
  RecordingHeader header;
  header.case_name = plan.the_case->name;
  header.case_source = "test";
  header.case_hash = plan.the_case->hash;
  header.settings_json = to_json(plan.settings);
  header.osteon_version = "test";
  auto writer = RecordingWriter::create(file, header);
  EXPECT_TRUE(writer) << (writer ? "" : writer.error().message());
  return writer ? std::make_unique<RecordFeed>(std::move(*writer), seconds) : nullptr;
}

inline void expect_identical_replay(const std::filesystem::path& file,
                                    std::shared_ptr<const Case> the_case, std::uint64_t ticks) {
  const auto recording = load_recording(file);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_TRUE(recording->complete);
  const auto outcome = replay(*recording, std::move(the_case));
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << "differs at tick " << outcome->first_different_tick;
  EXPECT_EQ(outcome->ticks, ticks);
}

/// Both loops in step: without physics the watchdog would rightly take the force away.
inline void run_both(Runtime& runtime, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    runtime.step_haptic_once();
    if (i % 2 == 1) runtime.step_physics_once();
  }
}

/// A device that passes everything on and keeps the newest force.
class LastForceDevice : public HapticDevice {
 public:
  explicit LastForceDevice(std::unique_ptr<HapticDevice> device) : device_(std::move(device)) {}
  const DeviceInfo& info() const override { return device_->info(); }
  DeviceSample read() override { return device_->read(); }
  void write_force(const Vec3& force_V) override {
    force_n = force_V.norm();
    device_->write_force(force_V);
  }
  void close() override { device_->close(); }

  double force_n = 0;

 private:
  std::unique_ptr<HapticDevice> device_;
};

/// The two loops of a run on a clock that the test sets: either may be starved.
struct StarvedLoops {
  explicit StarvedLoops(std::unique_ptr<HapticDevice> the_device)
      : device(std::move(the_device)),
        session(blocks_case(), {}),
        exchange(session.bones()),
        haptic(session, device, {}, exchange, nullptr),
        physics(session, exchange, nullptr) {
    enable();
  }
  void enable() { exchange.to_gate.push(GateWish::kEnable); }
  /// So many ticks of 1 ms, with physics or without.
  void run(int ticks, bool with_physics = true) {
    for (int i = 0; i < ticks; ++i) tick(0.001, with_physics && i % 2 == 1);
  }
  /// One tick that comes `dt_s` after the one before.
  void tick(double dt_s, bool with_physics) {
    haptic.step(dt_s);
    if (with_physics) physics.step();
  }
  double force_n() const { return device.force_n; }
  /// As the window is told, some ticks late.
  ForceOff cause() { return exchange.device_status.read().cause; }

  LastForceDevice device;
  Session session;
  LoopExchange exchange;
  HapticStage haptic;
  PhysicsStage physics;
};

}  // namespace osteon::test
