#pragma once

#include "joystick_profile.h"
#include "osteon/device/drivers.h"

namespace osteon {

/// Profiles of joysticks, and what is wrong with those that could not be read.
struct JoystickProfiles {
  std::vector<JoystickProfile> sound;
  std::vector<std::string> problems;
};
/// Every *.toml in the folder whose driver is "joystick", by file name.
JoystickProfiles load_joystick_profiles(const std::filesystem::path& folder);

/// Joysticks of these profiles on that bus that can be opened now; each with its serial number, or
/// its port when it has none.
std::vector<DeviceInfo> list_joysticks(UsbBus& bus, const JoystickProfiles& profiles);
Result<std::unique_ptr<HapticDevice>> open_joystick(UsbBus& bus, const JoystickProfiles& profiles,
                                                    const DeviceInfo& info);
/// Joysticks that are there but cannot be opened, and profiles that cannot be read.
std::vector<std::string> unusable_joysticks(UsbBus& bus, const JoystickProfiles& profiles);

// For the table of drivers: the system's USB and the profiles that Osteon ships.
Result<std::vector<DeviceInfo>> list_usb_joysticks();
Result<std::unique_ptr<HapticDevice>> open_usb_joystick(const DeviceInfo& info);
std::vector<std::string> unusable_usb_joysticks();

}  // namespace osteon
