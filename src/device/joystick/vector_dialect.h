#pragma once

#include "joystick_dialect.h"
#include "vector_report.h"

namespace osteon {

/// The 1 kHz vector report (docs/joystick-firmware.md). Nothing to bring up: it answers from the
/// first frame on.
class VectorDialect : public JoystickDialect {
 public:
  /// `with_torque`: the joystick drives a rotation, and takes the longer report.
  explicit VectorDialect(bool with_torque) : with_torque_(with_torque) {}
  Result<void> open(UsbLink&) override { return {}; }
  void start() override;
  void step(UsbLink&) override {}
  BringUp bring_up() const override { return BringUp::kReady; }
  const char* failure() const override { return ""; }
  ReportKind read(const UsbPacket& packet, JoystickReading& reading) override;
  const JoystickStatus& status() const override { return status_; }
  bool send(UsbLink& link, const DeviceWrench& wrench) override;
  void home() override { home_wanted_ = true; }
  void shut_down(UsbLink& link) override;
  double resolution_m() const override { return 1e-7; }
  double resolution_rad() const override { return 6.283185307179586 / 65536; }

 private:
  void update_status(const VectorState& state);
  std::int64_t unwrapped_ns(std::uint32_t time_us);
  bool write(UsbLink& link, const VectorCommand& command) const;

  bool with_torque_;
  JoystickStatus status_;
  std::uint16_t sequence_ = 0;
  bool sent_ = false;      ///< since `start`
  bool followed_ = false;  ///< the device has followed a command since `start`
  bool home_wanted_ = false;
  std::uint32_t last_time_us_ = 0;
  std::int64_t time_us_ = 0;
};

}  // namespace osteon
