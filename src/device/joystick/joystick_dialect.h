#pragma once

#include <memory>

#include "joystick_profile.h"
#include "osteon/base/result.h"

namespace osteon {

/// What one report from the joystick said.
struct JoystickReading {
  std::int64_t time_ns = 0;  ///< when the device read its sensors, on a clock of steady rate
  Vec3 p_V = Vec3::Zero();
  double turn_rad = 0;  ///< about the profile's rotation axis
  std::uint32_t buttons = 0;
  std::uint8_t instrument = 0;  ///< code of the handle in use; 0: the device does not tell
};

/// What the device says of itself, from its newest report that tells.
struct JoystickStatus {
  bool homed = true;
  bool dead_man_held = true;
  ForceOff refusal = ForceOff::kNone;
  double motor_heat = -1;
};

enum class ReportKind : std::uint8_t { kBad, kReading, kStatus };
enum class BringUp : std::uint8_t { kRunning, kReady, kFailed };

/// How a joystick speaks. `start` and `step` bring it up without waiting; `open` and `shut_down`
/// may wait. None but `open` allocates.
class JoystickDialect {
 public:
  virtual ~JoystickDialect() = default;
  /// Learns what it needs of the device.
  virtual Result<void> open(UsbLink& link) = 0;
  virtual void start() = 0;
  virtual void step(UsbLink& link) = 0;
  virtual BringUp bring_up() const = 0;
  /// Why bring-up failed, in words; empty otherwise.
  virtual const char* failure() const = 0;
  /// Reads one packet into `reading` or into `status()`.
  virtual ReportKind read(const UsbPacket& packet, JoystickReading& reading) = 0;
  virtual const JoystickStatus& status() const = 0;
  /// Sends a force, N, and where rotations are driven a torque, N m; finite. Last wins. False: it
  /// cannot be sent.
  virtual bool send(UsbLink& link, const DeviceWrench& wrench) = 0;
  virtual void home() = 0;
  /// Zero force, motors off; waits until the device has it, at most some ten milliseconds.
  virtual void shut_down(UsbLink& link) = 0;
  /// Smallest step of a position and of a rotation that the reports can tell.
  virtual double resolution_m() const = 0;
  virtual double resolution_rad() const = 0;
};

}  // namespace osteon
