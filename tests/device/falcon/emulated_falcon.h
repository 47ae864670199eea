#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "emulated/emulated_usb.h"
#include "emulated/joystick_descriptors.h"
#include "falcon/falcon_packet.h"
#include "osteon/device/virtual_hand.h"

namespace osteon::testing {

/// A Novint Falcon to the byte: its serial converter, its boot loader, its firmware, and a delta
/// robot with a hand on its grip. Motors keep what they were last told: the harder of the two
/// things that the real firmware may do when nobody speaks to it.
class EmulatedFalcon : public EmulatedUsbDevice {
 public:
  explicit EmulatedFalcon(std::vector<std::uint8_t> firmware, const HandParams& hand = {});

  UsbEntry entry() const override { return {0x0403, 0xcb48, serial, "FALCON HAPTIC", "", ""}; }
  bool control(const UsbSetup& setup, std::span<const std::uint8_t> out, std::span<std::uint8_t> in,
               std::size_t& in_size) override;
  void take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) override;
  std::size_t give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) override;
  void advance(std::int64_t now_ns) override;
  void disconnected() override;

  // The hand, in V.
  void take_hold(const Vec3& p_V);
  void want(const Vec3& p_V, const Vec3& v_V = Vec3::Zero());
  Vec3 position_V() const;
  void press(std::uint8_t buttons) { grip_ = buttons; }

  // What can be seen of it.
  Vec3 motor_force() const;
  const FalconCommand& command() const { return command_; }
  bool runs() const { return state_ == State::kRunning; }
  std::uint8_t homed() const { return homed_; }
  const std::vector<std::array<std::uint16_t, 2>>& requests() const { return requests_; }
  std::size_t loaded() const { return loaded_; }

  // What can go wrong with it.
  void lose_homing() { homed_ = 0; }
  void switch_off_and_on();
  void home_now() { homed_ = 7; }
  std::string serial = "FN0001";
  int deaf_greetings = 0;     ///< greetings that the boot loader misses
  bool leading_zero = false;  ///< before its answer
  std::size_t wrong_echo_at = SIZE_MAX;
  bool dead = false;      ///< takes everything and answers nothing
  bool nonsense = false;  ///< well-formed readings that belong to no position

 private:
  enum class State { kBoot, kGreeted, kLoading, kRunning, kStuck };
  void hear(std::uint8_t byte);
  void hear_greeting(std::uint8_t byte);
  void hear_firmware(std::uint8_t byte);
  void hear_command(std::uint8_t byte);
  void say(std::initializer_list<std::uint8_t> bytes);
  void answer();
  void step();
  std::array<int, 3> true_counts() const;

  std::vector<std::uint8_t> firmware_;
  VirtualHand hand_;
  Pose wanted_F_;
  Vec3 wanted_v_F_ = Vec3::Zero();
  Vec3 force_F_ = Vec3::Zero();

  State state_ = State::kBoot;
  std::uint16_t baud_ = 0;
  std::uint16_t latency_ms_ = 16;
  bool dtr_ = true;
  std::vector<std::array<std::uint16_t, 2>> requests_;
  std::vector<std::uint8_t> heard_;
  std::deque<std::uint8_t> to_host_;
  std::size_t loaded_ = 0;
  FalconPacketReader reader_;
  FalconCommand command_;
  std::uint8_t homed_ = 0;
  std::uint8_t grip_ = 0;
  std::array<int, 3> offsets_{700, -300, 123};  ///< of encoders that have not seen their mark
  std::array<int, 3> last_counts_{};
  std::int64_t stepped_ns_ = -1;
  std::int64_t now_ns_ = 0;
  std::int64_t said_ns_ = 0;
};

/// What its serial converter tells of itself.
JoystickDescriptors falcon_descriptors();

/// Bytes that stand for the firmware: nobody may ship the real one.
std::vector<std::uint8_t> pretended_firmware(std::size_t size = 1000);

}  // namespace osteon::testing
