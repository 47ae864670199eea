#pragma once

#include "emulated_usb.h"
#include "joystick_mechanics.h"

namespace osteon {

/// The vector dialect's joystick, byte by byte after docs/joystick-firmware.md, written apart from
/// the host's side so that the two check each other.
class EmulatedVectorJoystick : public EmulatedUsbDevice {
 public:
  explicit EmulatedVectorJoystick(std::string serial = "V0001", const HandParams& hand = {})
      : serial_(std::move(serial)), mechanics_(hand) {}

  UsbEntry entry() const override;
  bool control(const UsbSetup& setup, std::span<const std::uint8_t> out, std::span<std::uint8_t> in,
               std::size_t& in_size) override;
  void take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) override;
  std::size_t give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) override;
  void advance(std::int64_t now_ns) override;

  JoystickMechanics& mechanics() { return mechanics_; }
  /// For tests: what the firmware would sense.
  void set_status_bit(std::uint8_t bit, bool on);
  /// Another handle is put on.
  void set_instrument(std::uint8_t code) { instrument_ = code; }
  /// It is one that drives its rotation: its firmware takes the report with a torque.
  void set_drives_rotation(bool drives) { drives_rotation_ = drives; }
  std::uint64_t refused() const { return refused_; }

  static constexpr std::int64_t kTimeout_ns = 20'000'000;

 private:
  std::string serial_;
  JoystickMechanics mechanics_;
  std::int64_t now_ns_ = 0;
  std::int64_t last_command_ns_ = 0;
  std::uint8_t sensed_ = 0x04;  ///< status bits beside motors and time-out; homed
  std::uint8_t instrument_ = 0;
  bool drives_rotation_ = false;
  bool timed_out_ = true;
  bool motors_on_ = false;
  bool fresh_ = false;
  std::uint16_t applied_ = 0;
  std::uint16_t sequence_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace osteon
