#include "virtual_usb.h"

#include "emulated_pid_joystick.h"
#include "emulated_vector_joystick.h"
#include "osteon/base/file.h"
#include "period.h"

namespace osteon {
namespace {

// The profile of the real joystick, under the name of its emulation.
Result<JoystickProfile> emulated_profile(const char* file, const char* driver) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto profile = load_joystick_profile(*data / "assets" / "devices" / file);
  if (!profile) return profile;
  profile->info.driver = driver;
  profile->info.name += " (emulated)";
  return profile;
}

Result<JoystickProfile> pid_profile() {
  return emulated_profile("joystick_pid.toml", "virtual-usb-pid");
}
Result<JoystickProfile> vector_profile() {
  return emulated_profile("joystick_vector.toml", "virtual-usb-vector");
}

Result<JoystickProfile> torque_profile() {
  return emulated_profile("joystick_vector_torque.toml", "virtual-usb-torque");
}

Result<std::vector<DeviceInfo>> list_of(const Result<JoystickProfile>& profile) {
  if (!profile) return tl::unexpected(profile.error());
  return std::vector<DeviceInfo>{profile->info};
}

Result<std::unique_ptr<HapticDevice>> open_of(const Result<JoystickProfile>& profile) {
  if (!profile) return tl::unexpected(profile.error());
  auto device = VirtualUsbJoystick::open(*profile);
  if (!device) return tl::unexpected(device.error());
  return std::move(*device);
}

}  // namespace

Result<std::unique_ptr<VirtualUsbJoystick>> VirtualUsbJoystick::open(const JoystickProfile& profile,
                                                                     const HandParams& hand,
                                                                     UsbSpeed pid_speed) {
  std::unique_ptr<VirtualUsbJoystick> made(new VirtualUsbJoystick);
  if (profile.dialect == JoystickDialectKind::kPid) {
    auto device = std::make_shared<EmulatedPidJoystick>("P0001", pid_speed, hand);
    made->mechanics_ = &device->mechanics();
    made->device_ = std::move(device);
  } else {
    auto device = std::make_shared<EmulatedVectorJoystick>("V0001", hand);
    device->set_drives_rotation(profile.info.drives_rotation());
    made->mechanics_ = &device->mechanics();
    made->device_ = std::move(device);
  }
  made->port_ = made->bus_.attach(made->device_);
  UsbEntry entry = made->device_->entry();
  entry.port = made->port_;
  auto link = made->bus_.open(entry, profile.channel);
  if (!link) return tl::unexpected(link.error());
  auto joystick = JoystickDevice::start(profile, std::move(*link));
  if (!joystick) return tl::unexpected(joystick.error());
  made->joystick_ = std::move(*joystick);
  return made;
}

void VirtualUsbJoystick::set_target(const Pose& wanted_VD, const Vec3& wanted_v_V,
                                    std::uint32_t buttons) {
  mechanics_->set_target(wanted_VD, wanted_v_V, buttons);
  wanted_.store(true, std::memory_order_release);
}

// The hand is at its first target at once. Readings that leap so would be refused: a pause makes it
// a new beginning.
void VirtualUsbJoystick::place_hand() {
  constexpr std::int64_t kPause_ns = JoystickDevice::kSilence_ns + 2'000'000;
  bus_.faults(port_).silent_until_ns = bus_.now_ns() + kPause_ns;
  bus_.advance(kPause_ns);
  placed_ = true;
}

DeviceSample VirtualUsbJoystick::read() {
  if (!placed_ && wanted_.load(std::memory_order_acquire)) place_hand();
  bus_.advance(to_ns(period_s(info())));
  return joystick_->read();
}

Result<std::vector<DeviceInfo>> list_virtual_usb_pid() { return list_of(pid_profile()); }
Result<std::vector<DeviceInfo>> list_virtual_usb_vector() { return list_of(vector_profile()); }
Result<std::vector<DeviceInfo>> list_virtual_usb_torque() { return list_of(torque_profile()); }
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_pid(const DeviceInfo&) {
  return open_of(pid_profile());
}
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_vector(const DeviceInfo&) {
  return open_of(vector_profile());
}
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_torque(const DeviceInfo&) {
  return open_of(torque_profile());
}

}  // namespace osteon
