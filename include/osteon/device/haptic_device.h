#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// What a device can do; from its profile.
struct DeviceInfo {
  std::string name;
  std::string driver;
  std::array<bool, 3> force_axes{true, true, true};      ///< driven X, Y, Z
  std::array<bool, 3> torque_axes{false, false, false};  ///< driven rotations
  double peak_force_n = 0;
  double continuous_force_n = 0;
  double max_stiffness_n_per_m = 0;
  double max_slew_n_per_s = 4000;
  Vec3 workspace_m = Vec3::Zero();  ///< full extent along X, Y, Z of Device
  double rate_hz = 1000;
  /// Which of several like it: a serial number or a port; empty where there is only one.
  std::string serial;
  /// Has a switch or a pedal that must be held for force (DeviceSample::dead_man_held).
  bool has_dead_man = false;
  // Of the driven rotations; all 0 where there are none.
  double peak_torque_nm = 0;
  double continuous_torque_nm = 0;
  double max_torque_slew_nm_per_s = 0;

  /// A rotation with a motor whose limits are not told gets no torque.
  bool drives_rotation() const {
    return peak_torque_nm > 0 && (torque_axes[0] || torque_axes[1] || torque_axes[2]);
  }
};

/// What a device's motors do to the hand, in V.
struct DeviceWrench {
  Vec3 force_V = Vec3::Zero();   ///< N
  Vec3 torque_V = Vec3::Zero();  ///< N m, about the stylus' origin (that of DeviceSample::X_VD)
};

enum class ForceOff : std::uint8_t {
  kNone,
  kButton,
  kVelocity,
  kWatchdog,
  kSoftware,
  kDisconnect,
  kDeadMan,
  kNotFinite,
  kTemperature,  ///< the motors are too warm
  kCalibration,  ///< not calibrated or homed, or no longer so
  kDeviceFault   ///< the device reports a fault of its own
};
/// In words for the window: "The joystick stopped answering".
const char* describe(ForceOff cause);

/// One reading, in the Device frame (x right, y up, z towards the user), SI.
struct DeviceSample {
  std::int64_t time_ns = 0;
  Pose X_VD;                ///< stylus in the device's own frame V
  Vec3 v_V = Vec3::Zero();  ///< m/s
  Vec3 w_V = Vec3::Zero();  ///< rad/s
  std::uint32_t buttons = 0;
  bool connected = true;
  /// Calibrated or homed, so that the pose means something and force may be given.
  bool calibrated = true;
  bool dead_man_held = true;           ///< true where the device has none
  ForceOff refusal = ForceOff::kNone;  ///< why the device itself gives no force now
  /// Code (Instrument::code) of the instrument whose handle the device recognises; 0: none.
  std::uint8_t instrument_code = 0;
};

enum class Calibration : std::uint8_t { kNotNeeded, kNeeded, kRunning, kDone };

/// How a device does, for a window and for `osteon doctor`; not for the tick.
struct DeviceHealth {
  Calibration calibration = Calibration::kNotNeeded;
  /// What the user should do now ("Move the stylus into the inkwell"); empty: nothing.
  const char* advice = "";
  /// Warmest motor as a share of its limit; below 0 when the device does not tell.
  double motor_heat = -1;
  std::uint64_t reports_in = 0;   ///< readings received
  std::uint64_t reports_out = 0;  ///< forces that reached the device
  std::uint64_t replaced = 0;     ///< forces replaced by a newer one before they were sent
  std::uint64_t bad_reports = 0;  ///< readings that were refused: short, garbled, out of range
};

/// A thing that is held in the hand and may push back. Used by one thread at a time. Drivers are
/// listed in an explicit table (device/drivers.h).
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceInfo& info() const = 0;
  /// Newest sample; never waits. `time_ns` stays the same until the device has sent a new reading.
  virtual DeviceSample read() = 0;
  /// Force on the hand, N, in V. Replaces the last one; never waits.
  virtual void write_force(const Vec3& force_V) = 0;
  /// Torque on the hand about the stylus' origin, N m, in V: goes out with the next force, and with
  /// that one alone. Nothing to do where no rotation is driven.
  virtual void write_torque(const Vec3& torque_V) { (void)torque_V; }
  void write(const DeviceWrench& wrench) {
    write_torque(wrench.torque_V);
    write_force(wrench.force_V);
  }
  /// Zero force, then released. Safe to call twice.
  virtual void close() = 0;
  virtual DeviceHealth health() const { return {}; }
  /// Starts calibration or homing by the user's wish; `read` carries it on and `health` tells how
  /// far it is. Nothing to do for devices that need none.
  virtual void calibrate() {}
};

}  // namespace osteon
