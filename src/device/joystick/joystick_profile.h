#pragma once

#include <array>
#include <filesystem>

#include "osteon/device/haptic_device.h"
#include "profile_reader.h"
#include "usb/usb_transport.h"

namespace osteon {

enum class JoystickDialectKind : std::uint8_t { kPid, kVector };

/// An axis of a HID report on V's: usage of page 1 (Generic Desktop), its sense, and what the
/// logical maximum means (m or rad from the middle).
struct HidAxis {
  std::uint16_t usage = 0x30;
  int sign = 1;
  double half_range = 0;
};

/// A joystick's profile: what every device has, and how this one speaks.
struct JoystickProfile {
  DeviceInfo info;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  UsbChannel channel;
  JoystickDialectKind dialect = JoystickDialectKind::kVector;
  /// The firmware drops its force so long after the last report; 0: never.
  double firmware_timeout_s = 0;
  int dead_man_button = -1;  ///< bit of the buttons that must be held; -1: none
  // Dialect `pid` alone; the vector report fixes its own units.
  double full_scale_force_n = 0;                                ///< of the largest magnitude
  std::array<HidAxis, 3> axes{};                                ///< X, Y, Z of V
  std::array<std::uint16_t, 3> force_usages{0x30, 0x31, 0x32};  ///< effect axes of X, Y, Z of V
  HidAxis rotation{0x35, 1, 0};
  Vec3 rotation_axis_V = Vec3::UnitZ();
};

/// Strict, as load_device_profile.
Result<JoystickProfile> load_joystick_profile(const std::filesystem::path& path);
/// Complains of what is wrong in the table [joystick].
void check_joystick_table(ProfileReader& in, const DeviceInfo& info);

}  // namespace osteon
