#include "joystick_driver.h"

#include <algorithm>

#include "joystick_device.h"
#include "osteon/base/file.h"
#include "usb/libusb_bus.h"

namespace osteon {
namespace {

std::vector<std::filesystem::path> profile_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

DeviceInfo info_of(const JoystickProfile& profile, const UsbEntry& entry) {
  DeviceInfo info = profile.info;
  info.serial = entry.serial.empty() ? entry.port : entry.serial;
  return info;
}

JoystickProfiles shipped_profiles() {
  const auto data = find_data_dir();
  if (!data) return {{}, {data.error().message()}};
  return load_joystick_profiles(*data / "assets" / "devices");
}

}  // namespace

JoystickProfiles load_joystick_profiles(const std::filesystem::path& folder) {
  JoystickProfiles profiles;
  for (const auto& file : profile_files(folder)) {
    const auto root = parse_profile(file);
    if (!root) {
      profiles.problems.push_back(root.error().message());
      continue;
    }
    if ((*root)["driver"].value_or(std::string_view()) != "joystick") continue;
    auto profile = load_joystick_profile(file);
    if (profile)
      profiles.sound.push_back(std::move(*profile));
    else
      profiles.problems.push_back(profile.error().message());
  }
  return profiles;
}

std::vector<DeviceInfo> list_joysticks(UsbBus& bus, const JoystickProfiles& profiles) {
  std::vector<DeviceInfo> infos;
  for (const JoystickProfile& profile : profiles.sound)
    for (const UsbEntry& entry : bus.list(profile.vendor, profile.product))
      if (entry.access_problem.empty()) infos.push_back(info_of(profile, entry));
  return infos;
}

Result<std::unique_ptr<HapticDevice>> open_joystick(UsbBus& bus, const JoystickProfiles& profiles,
                                                    const DeviceInfo& info) {
  for (const JoystickProfile& profile : profiles.sound) {
    if (profile.info.name != info.name) continue;
    for (const UsbEntry& entry : bus.list(profile.vendor, profile.product)) {
      JoystickProfile of_this = profile;
      of_this.info = info_of(profile, entry);
      if (!info.serial.empty() && of_this.info.serial != info.serial) continue;
      auto link = bus.open(entry, profile.channel);
      if (!link) return tl::unexpected(link.error());
      auto device = JoystickDevice::start(of_this, std::move(*link));
      if (!device) return tl::unexpected(device.error());
      return std::move(*device);
    }
  }
  return fail("the joystick is no longer there", info.name + " " + info.serial,
              "Plug it in again and choose it");
}

std::vector<std::string> unusable_joysticks(UsbBus& bus, const JoystickProfiles& profiles) {
  std::vector<std::string> reasons = profiles.problems;
  for (const JoystickProfile& profile : profiles.sound)
    for (const UsbEntry& entry : bus.list(profile.vendor, profile.product))
      if (!entry.access_problem.empty())
        reasons.push_back(profile.info.name + ": " + entry.access_problem);
  return reasons;
}

// A computer without USB has no joysticks: no error.
Result<std::vector<DeviceInfo>> list_usb_joysticks() {
  const auto bus = open_libusb_bus();
  if (!bus) return std::vector<DeviceInfo>{};
  return list_joysticks(**bus, shipped_profiles());
}

Result<std::unique_ptr<HapticDevice>> open_usb_joystick(const DeviceInfo& info) {
  const auto bus = open_libusb_bus();
  if (!bus) return tl::unexpected(bus.error());
  return open_joystick(**bus, shipped_profiles(), info);
}

std::vector<std::string> unusable_usb_joysticks() {
  const auto bus = open_libusb_bus();
  if (!bus) return {bus.error().message()};
  return unusable_joysticks(**bus, shipped_profiles());
}

}  // namespace osteon
