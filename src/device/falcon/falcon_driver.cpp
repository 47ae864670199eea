#include "falcon_driver.h"

#include "falcon_bringup.h"
#include "falcon_device.h"
#include "osteon/base/file.h"
#include "osteon/device/profile.h"
#include "usb/libusb_bus.h"

namespace osteon {
namespace {

std::string identity(const UsbEntry& entry) {
  return entry.serial.empty() ? entry.port : entry.serial;
}

Result<DeviceInfo> falcon_profile() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_device_profile(*data / "assets" / "devices" / "falcon.toml");
}

}  // namespace

Result<std::vector<DeviceInfo>> list_falcons(UsbBus& bus) {
  std::vector<DeviceInfo> out;
  const auto entries = bus.list(kFalconVendor, kFalconProduct);
  if (entries.empty() || !load_falcon_firmware()) return out;
  const auto profile = falcon_profile();
  if (!profile) return tl::unexpected(profile.error());
  for (const UsbEntry& entry : entries) {
    if (!entry.access_problem.empty()) continue;
    out.push_back(*profile);
    out.back().serial = identity(entry);
  }
  return out;
}

Result<std::unique_ptr<HapticDevice>> open_falcon(UsbBus& bus, const DeviceInfo& info) {
  const auto firmware = load_falcon_firmware();
  if (!firmware) return tl::unexpected(firmware.error());
  for (const UsbEntry& entry : bus.list(kFalconVendor, kFalconProduct)) {
    if (!info.serial.empty() && identity(entry) != info.serial) continue;
    auto link = bus.open(entry, falcon_channel());
    if (!link) return tl::unexpected(link.error());
    if (const auto up = bring_up_falcon(**link, *firmware); !up) return tl::unexpected(up.error());
    return std::make_unique<FalconDevice>(std::move(*link), info);
  }
  return fail("the Novint Falcon is no longer there", info.serial, "Plug it in");
}

std::vector<std::string> unusable_falcons(UsbBus& bus) {
  std::vector<std::string> out;
  const auto entries = bus.list(kFalconVendor, kFalconProduct);
  for (const UsbEntry& entry : entries)
    if (!entry.access_problem.empty())
      out.push_back("Novint Falcon at USB port " + entry.port + ": " + entry.access_problem);
  if (entries.empty()) return out;
  if (const auto firmware = load_falcon_firmware(); !firmware)
    out.push_back(firmware.error().message());
  return out;
}

// Without USB there is no Falcon; that the system has none is for the joystick's line to say.
Result<std::vector<DeviceInfo>> list_falcon() {
  const auto bus = open_libusb_bus();
  if (!bus) return std::vector<DeviceInfo>{};
  return list_falcons(**bus);
}

Result<std::unique_ptr<HapticDevice>> open_falcon(const DeviceInfo& info) {
  const auto bus = open_libusb_bus();
  if (!bus) return tl::unexpected(bus.error());
  return open_falcon(**bus, info);
}

std::vector<std::string> unusable_falcon() {
  const auto bus = open_libusb_bus();
  if (!bus) return {};
  return unusable_falcons(**bus);
}

}  // namespace osteon
