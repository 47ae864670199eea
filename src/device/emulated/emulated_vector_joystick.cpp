#include "emulated_vector_joystick.h"

#include <algorithm>
#include <cmath>

#include "angles.h"
#include "joystick_descriptors.h"

namespace osteon {
namespace {

// Bit by bit as a small firmware would: the check value of "123456789" is 0x29B1.
std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes)
    for (int bit = 7; bit >= 0; --bit) {
      const bool top = ((crc >> 15) ^ (byte >> bit)) & 1;
      crc = static_cast<std::uint16_t>(crc << 1);
      if (top) crc ^= 0x1021;
    }
  return crc;
}

void put(std::span<std::uint8_t> packet, std::size_t at, std::size_t bytes, std::int64_t value) {
  for (std::size_t i = 0; i < bytes; ++i)
    packet[at + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
}

std::int16_t signed16(std::span<const std::uint8_t> packet, std::size_t at) {
  return static_cast<std::int16_t>(packet[at] | packet[at + 1] << 8);
}

}  // namespace

UsbEntry EmulatedVectorJoystick::entry() const {
  return {0x1209, 0x0001, serial_, vector_joystick_descriptors().product, "", ""};
}

bool EmulatedVectorJoystick::control(const UsbSetup& setup, std::span<const std::uint8_t>,
                                     std::span<std::uint8_t> in, std::size_t& in_size) {
  JoystickDescriptors descriptors = vector_joystick_descriptors();
  descriptors.serial = serial_.c_str();
  return answer_descriptor(descriptors, setup, in, in_size);
}

void EmulatedVectorJoystick::take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) {
  // The one without torque, or for driven rotations the one with.
  const std::size_t size = drives_rotation_ ? 18 : 12;
  const bool sound =
      endpoint == 0x02 && bytes.size() == size && bytes[0] == (drives_rotation_ ? 0x03 : 0x01) &&
      (bytes[1] & 0xFC) == 0 &&
      static_cast<std::uint16_t>(signed16(bytes, size - 2)) == crc16(bytes.first(size - 2));
  if (!sound) {
    ++refused_;
    return;
  }
  last_command_ns_ = now_ns_;
  timed_out_ = false;
  applied_ = static_cast<std::uint16_t>(signed16(bytes, 2));
  if ((bytes[1] & 0x02) != 0) sensed_ |= 0x04;  // it homes where it is
  motors_on_ = (bytes[1] & 0x01) != 0 && (sensed_ & 0x18) == 0;
  if (!motors_on_) return mechanics_.set_motors(Vec3::Zero());
  const auto triple = [&](std::size_t at) {
    return Vec3(signed16(bytes, at), signed16(bytes, at + 2), signed16(bytes, at + 4));
  };
  mechanics_.set_motors(1e-3 * triple(4),
                        drives_rotation_ ? Vec3(1e-4 * triple(10)) : Vec3(Vec3::Zero()));
}

void EmulatedVectorJoystick::set_status_bit(std::uint8_t bit, bool on) {
  sensed_ = static_cast<std::uint8_t>(on ? sensed_ | bit : sensed_ & ~bit);
}

void EmulatedVectorJoystick::advance(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (now_ns - last_command_ns_ >= kTimeout_ns) timed_out_ = true;
  if (timed_out_ || (sensed_ & 0x18) != 0) {
    motors_on_ = false;
    mechanics_.set_motors(Vec3::Zero());
  }
  mechanics_.advance(now_ns);
  fresh_ = fresh_ || now_ns % JoystickMechanics::kStep_ns == 0;
}

std::size_t EmulatedVectorJoystick::give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) {
  if (endpoint != 0x81 || !fresh_) return 0;
  fresh_ = false;
  const VirtualHand& hand = mechanics_.hand();
  packet[0] = 0x02;
  packet[1] =
      static_cast<std::uint8_t>(sensed_ | (motors_on_ ? 0x01 : 0) | (timed_out_ ? 0x02 : 0));
  put(packet, 2, 2, ++sequence_);
  put(packet, 4, 2, applied_);
  put(packet, 6, 4, now_ns_ / 1000);
  for (int i = 0; i < 3; ++i) {
    const double steps = std::clamp(hand.pose().p[i] * 1e7, -2147483647.0, 2147483647.0);
    put(packet, 10 + 4 * static_cast<std::size_t>(i), 4, std::llround(steps));
  }
  put(packet, 22, 2, std::llround(mechanics_.turn_about(Vec3::UnitZ()) * (65536 / kTurn_rad)));
  put(packet, 24, 2, mechanics_.buttons());
  packet[26] = 0xFF;  // its motors have no thermometer
  packet[27] = instrument_;
  put(packet, 28, 2, crc16(packet.first(28)));
  return 30;
}

}  // namespace osteon
