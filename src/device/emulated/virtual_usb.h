#pragma once

#include <atomic>

#include "emulated_usb.h"
#include "joystick/joystick_device.h"
#include "osteon/device/drivers.h"
#include "osteon/device/emulated_user.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {

class JoystickMechanics;

/// An emulated joystick on an emulated bus behind the driver that a real one has: every reading and
/// every force goes through the reports' bytes. Its clock is virtual: each `read` is one period of
/// the profile's rate. The first target places the hand there.
class VirtualUsbJoystick : public HapticDevice, public EmulatedUser {
 public:
  /// `pid_speed`: a vector joystick is of full speed.
  static Result<std::unique_ptr<VirtualUsbJoystick>> open(const JoystickProfile& profile,
                                                          const HandParams& hand = {},
                                                          UsbSpeed pid_speed = UsbSpeed::kHigh);
  ~VirtualUsbJoystick() override { VirtualUsbJoystick::close(); }
  void set_target(const Pose& wanted_VD, const Vec3& wanted_v_V, std::uint32_t buttons) override;

  const DeviceInfo& info() const override { return joystick_->info(); }
  DeviceSample read() override;
  /// A read without time passing on the bus.
  DeviceSample read_newest() { return joystick_->read(); }
  void write_force(const Vec3& force_V) override { joystick_->write_force(force_V); }
  void write_torque(const Vec3& torque_V) override { joystick_->write_torque(torque_V); }
  void close() override { joystick_->close(); }
  DeviceHealth health() const override { return joystick_->health(); }
  void calibrate() override { joystick_->calibrate(); }

  EmulatedUsbBus& bus() { return bus_; }
  const std::string& port() const { return port_; }
  JoystickMechanics& mechanics() { return *mechanics_; }

 private:
  VirtualUsbJoystick() = default;
  void place_hand();
  std::atomic<bool> wanted_{false};  ///< a target has been given, maybe by another thread
  bool placed_ = false;

  EmulatedUsbBus bus_;
  std::shared_ptr<EmulatedUsbDevice> device_;
  JoystickMechanics* mechanics_ = nullptr;  ///< of device_
  std::string port_;
  std::unique_ptr<JoystickDevice> joystick_;
};

// For the table of drivers.
Result<std::vector<DeviceInfo>> list_virtual_usb_pid();
Result<std::vector<DeviceInfo>> list_virtual_usb_vector();
Result<std::vector<DeviceInfo>> list_virtual_usb_torque();
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_pid(const DeviceInfo& info);
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_vector(const DeviceInfo& info);
Result<std::unique_ptr<HapticDevice>> open_virtual_usb_torque(const DeviceInfo& info);

}  // namespace osteon
