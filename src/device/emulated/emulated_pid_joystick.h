#pragma once

#include <array>

#include "emulated_usb.h"
#include "joystick_mechanics.h"

namespace osteon {

/// A joystick of HID PID class 1.0 with three force axes, byte by byte in the usual layout: its
/// effect memory, device control, state and axis reports, and a 20 ms time-out of its own. Frame:
/// HID X = V's x, HID Y = V's z, HID Z = -V's y.
class EmulatedPidJoystick : public EmulatedUsbDevice {
 public:
  explicit EmulatedPidJoystick(std::string serial = "P0001", UsbSpeed speed = UsbSpeed::kFull,
                               const HandParams& hand = {})
      : serial_(std::move(serial)), speed_(speed), mechanics_(hand) {}

  UsbEntry entry() const override;
  UsbSpeed speed() const override { return speed_; }
  bool has_out_endpoint(std::uint8_t address) const override {
    return out_endpoint_ && address == 0x02;
  }
  /// As many simple joysticks: its interface has no OUT endpoint, output reports come by SET_REPORT
  /// alone.
  void leave_out_endpoint_away() { out_endpoint_ = false; }
  bool control(const UsbSetup& setup, std::span<const std::uint8_t> out, std::span<std::uint8_t> in,
               std::size_t& in_size) override;
  void take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) override;
  std::size_t give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) override;
  void advance(std::int64_t now_ns) override;

  JoystickMechanics& mechanics() { return mechanics_; }
  /// The next so many requests for a loaded block are answered "error": as slow firmware does.
  void set_slow_loads(int count) { slow_loads_ = count; }
  /// Room for so many effects.
  void set_room(std::size_t effects) { room_ = std::min<std::size_t>(effects, kEffects); }
  /// The dead-man ("safety") switch and the motors' supply, told in the state report.
  void set_switches(bool safety, bool power);
  int effects_playing() const;
  bool actuators_on() const { return actuators_on_; }

  static constexpr std::int64_t kTimeout_ns = 20'000'000;
  static constexpr double kFullScale_n = 10;
  static constexpr double kHalfRange_mm[3] = {80, 60, 80};  ///< HID X, Y, Z

 private:
  static constexpr std::size_t kEffects = 40;
  struct Effect {
    bool used = false;
    bool playing = false;
    std::uint8_t axes = 0;
    std::uint8_t gain = 0;
    std::int16_t magnitude = 0;
  };
  bool output_report(std::span<const std::uint8_t> bytes);
  bool set_effect(std::span<const std::uint8_t> bytes);
  bool operate(std::uint8_t block, std::uint8_t operation);
  bool device_control(std::uint8_t what);
  bool create_effect(std::span<const std::uint8_t> bytes);
  bool feature_report(std::uint8_t id, std::span<std::uint8_t> in, std::size_t& in_size);
  Effect* effect(std::uint8_t block);
  void stop_all();
  void drive();
  std::size_t give_state(std::span<std::uint8_t> packet);
  std::size_t give_axes(std::span<std::uint8_t> packet);

  std::string serial_;
  UsbSpeed speed_;
  bool out_endpoint_ = true;
  JoystickMechanics mechanics_;
  std::array<Effect, kEffects> effects_{};
  std::size_t room_ = kEffects;
  std::uint8_t device_gain_ = 0;
  std::uint8_t loaded_ = 0;  ///< block that the last creation gave; 0: none
  bool full_ = false;
  int slow_loads_ = 0;
  bool actuators_on_ = false;
  bool paused_ = false;
  bool safety_ = true;
  bool power_ = true;
  bool state_changed_ = false;
  bool fresh_ = false;
  std::int64_t now_ns_ = 0;
  std::int64_t last_force_ns_ = 0;
};

}  // namespace osteon
