#pragma once

#include <optional>

#include "joystick_dialect.h"
#include "pid_layout.h"

namespace osteon {

/// HID PID class 1.0: one endless constant-force effect an axis, whose magnitudes are streamed.
/// Bring-up: pool, reset, enable actuators, gain; for each axis create, block load, set effect,
/// start. Each step is one control transfer that `step` follows.
class PidDialect : public JoystickDialect {
 public:
  explicit PidDialect(const JoystickProfile& profile) : profile_(profile) {}
  Result<void> open(UsbLink& link) override;
  void start() override;
  void step(UsbLink& link) override;
  BringUp bring_up() const override;
  const char* failure() const override { return failure_; }
  ReportKind read(const UsbPacket& packet, JoystickReading& reading) override;
  const JoystickStatus& status() const override { return status_; }
  bool send(UsbLink& link, const DeviceWrench& wrench) override;
  void home() override { start(); }
  void shut_down(UsbLink& link) override;
  double resolution_m() const override;
  double resolution_rad() const override;

 private:
  enum class Step : std::uint8_t {
    kPool,
    kReset,
    kActuators,
    kGain,
    kCreate,
    kBlockLoad,
    kSetEffect,
    kStart,
    kReady,
    kFailed
  };
  void begin(UsbLink& link);
  void finish(const UsbControlResult& result, std::int64_t now_ns);
  void finish_pool(std::span<const std::uint8_t> data);
  void finish_block_load(std::span<const std::uint8_t> data);
  void next_axis();
  void fail_with(const char* why);
  bool set_report(UsbLink& link, const PidReport& report);
  bool get_report(UsbLink& link, std::uint32_t collection);
  bool control(UsbLink& link, std::uint32_t usage);
  void control_and_wait_for(UsbLink& link, std::uint32_t usage);
  PidReport effect_report() const;
  bool read_axes(std::span<const std::uint8_t> bytes, JoystickReading& reading) const;
  void read_state(std::span<const std::uint8_t> bytes);
  std::int64_t steady_time(std::int64_t arrival_ns);

  JoystickProfile profile_;
  std::optional<PidLayout> layout_;
  JoystickStatus status_;
  Step step_ = Step::kPool;
  bool waiting_ = false;  ///< for the control transfer of step_
  std::int64_t not_before_ns_ = 0;
  std::size_t axis_ = 0;
  int tries_ = 0;
  std::array<std::uint8_t, 3> blocks_{};  ///< effect block index of each axis of V
  const char* failure_ = "";
  std::int64_t steady_ns_ = 0;
};

}  // namespace osteon
