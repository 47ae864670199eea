#include "osteon/device/drivers.h"

#include <array>
#include <string>

#include "emulated/virtual_usb.h"
#include "falcon/falcon_driver.h"
#include "joystick/joystick_driver.h"
#include "osteon/base/file.h"
#include "osteon/device/mouse_device.h"
#include "osteon/device/null_device.h"
#include "osteon/device/pad_device.h"
#include "osteon/device/profile.h"
#include "osteon/device/virtual_device.h"
#include "phantom/phantom_driver.h"

namespace osteon {
namespace {

using DeviceList = Result<std::vector<DeviceInfo>>;
using OpenDevice = Result<std::unique_ptr<HapticDevice>>;

// The one device of a driver, described by a profile that Osteon ships.
DeviceList list_profile(const char* file) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto info = load_device_profile(*data / "assets" / "devices" / file);
  if (!info) return tl::unexpected(info.error());
  return std::vector<DeviceInfo>{std::move(*info)};
}

DeviceList list_null() { return std::vector<DeviceInfo>{NullDevice().info()}; }
DeviceList list_virtual() { return list_profile("virtual_hand.toml"); }
DeviceList list_mouse() { return list_profile("mouse.toml"); }
DeviceList list_pad() { return list_profile("gamepad.toml"); }

OpenDevice open_null(const DeviceInfo&) { return std::make_unique<NullDevice>(); }
OpenDevice open_virtual(const DeviceInfo& info) { return std::make_unique<VirtualDevice>(info); }
OpenDevice open_mouse(const DeviceInfo& info) { return std::make_unique<MouseDevice>(info); }
OpenDevice open_pad(const DeviceInfo& info) { return std::make_unique<PadDevice>(info); }

constexpr std::array<Driver, 10> kDrivers{{
    {"mouse", "Mouse and keyboard: moves the probe, feels nothing", list_mouse, open_mouse,
     nullptr},
    {"gamepad", "Gamepad: sticks move the probe, feels nothing", list_pad, open_pad, nullptr},
    {"joystick", "USB 4-DOF force-feedback joystick, HID PID or vector report", list_usb_joysticks,
     open_usb_joystick, unusable_usb_joysticks},
    {"phantom", "PHANToM class arm (Touch, Desktop, Premium) through OpenHaptics", list_phantom,
     open_phantom, unusable_phantom},
    {"falcon", "Novint Falcon over USB", list_falcon, open_falcon, unusable_falcon},
    {"virtual", "Virtual hand: an emulated user who feels the force", list_virtual, open_virtual,
     nullptr},
    {"virtual-usb-pid", "Emulated USB joystick (HID PID), to the byte", list_virtual_usb_pid,
     open_virtual_usb_pid, nullptr},
    {"virtual-usb-vector", "Emulated USB joystick (vector report), to the byte",
     list_virtual_usb_vector, open_virtual_usb_vector, nullptr},
    {"virtual-usb-torque", "Emulated USB joystick whose rotation is driven, to the byte",
     list_virtual_usb_torque, open_virtual_usb_torque, nullptr},
    {"null", "No device", list_null, open_null, nullptr},
}};

}  // namespace

std::span<const Driver> drivers() { return kDrivers; }

Result<std::unique_ptr<HapticDevice>> open_device(std::string_view driver_name) {
  std::string known;
  for (const Driver& driver : kDrivers) {
    if (driver_name == driver.name) {
      const auto devices = driver.list();
      if (!devices) return tl::unexpected(devices.error());
      if (devices->empty()) return fail("no device was found", driver.name, "Plug it in");
      return driver.open(devices->front());
    }
    known += (known.empty() ? "" : ", ") + std::string(driver.name);
  }
  return fail("there is no such driver", std::string(driver_name), "Choose one of: " + known);
}

}  // namespace osteon
