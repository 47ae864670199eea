#pragma once

#include <memory>

#include "joystick_dialect.h"
#include "link_times.h"
#include "velocity_estimator.h"

namespace osteon {

/// The USB 4-DOF force-feedback joystick over any transport. Force on X, Y, Z; the rotation is
/// read, and driven where the profile says so. It gives no force while it is not brought up, has
/// sent nothing sound for 10 ms, or reports a fault; an unplugged joystick stays disconnected until
/// it is opened anew. A force that was not followed by another within 20 ms has ended in its
/// firmware: the next reading says so.
class JoystickDevice : public HapticDevice {
 public:
  static constexpr std::int64_t kSilence_ns = link_times::kSilence_ns;
  static constexpr std::int64_t kOrderLife_ns =
      link_times::kOrderLife_ns;                     ///< of a force, in its firmware
  static constexpr double kImpossible_m_per_s = 10;  ///< a reading that leaps so is a false one

  /// Takes an open link and brings the joystick up; waits for that, at most a second.
  static Result<std::unique_ptr<JoystickDevice>> start(const JoystickProfile& profile,
                                                       std::unique_ptr<UsbLink> link);
  ~JoystickDevice() override { close(); }
  JoystickDevice(const JoystickDevice&) = delete;
  JoystickDevice& operator=(const JoystickDevice&) = delete;

  const DeviceInfo& info() const override { return profile_.info; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void write_torque(const Vec3& torque_V) override { torque_V_ = torque_V; }
  void close() override;
  DeviceHealth health() const override;
  /// Clears a fault of the transport and brings the joystick up, or homes it, anew.
  void calibrate() override;

 private:
  JoystickDevice(const JoystickProfile& profile, std::unique_ptr<UsbLink> link);
  Result<void> wait_until_ready();
  void take_packets();
  void accept(const JoystickReading& reading, std::int64_t arrival_ns);
  bool leaps(const JoystickReading& reading) const;
  bool dead_man_held() const;
  ForceOff judge() const;
  bool too_late() const;
  DeviceWrench given(const DeviceWrench& wanted) const;

  JoystickProfile profile_;
  std::unique_ptr<UsbLink> link_;  ///< null once closed
  std::unique_ptr<JoystickDialect> dialect_;
  VelocityEstimator velocity_;
  VelocityEstimator turn_rate_;
  JoystickReading newest_;
  DeviceSample sample_;
  double turn_rad_ = 0;  ///< without the leaps at half a turn
  bool has_reading_ = false;
  int bad_in_a_row_ = 0;
  std::uint64_t bad_reports_ = 0;
  UsbCounters last_counters_;
  Vec3 torque_V_ = Vec3::Zero();  ///< for the next force
  bool force_given_ = false;      ///< the last command was not zero
  std::int64_t ordered_ns_ = 0;   ///< when it was given
};

}  // namespace osteon
