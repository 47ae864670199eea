#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "osteon/base/types.h"

namespace osteon {

// The vector dialect's reports: docs/joystick-firmware.md. Little-endian; each ends with a CRC.

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected.
std::uint16_t crc16_ccitt(std::span<const std::uint8_t> bytes);

struct VectorCommand {
  static constexpr std::size_t kBytes = 12;
  static constexpr std::uint8_t kId = 0x01;
  static constexpr std::uint8_t kMotorsOn = 0x01;
  static constexpr std::uint8_t kHome = 0x02;

  std::uint8_t flags = 0;
  std::uint16_t sequence = 0;
  Vec3 force_V = Vec3::Zero();  ///< N; travels in steps of 1 mN, up to 32.767 N

  // Of the longer report alone, for joysticks that drive a rotation.
  static constexpr std::size_t kBytesWithTorque = 18;
  static constexpr std::uint8_t kIdWithTorque = 0x03;
  Vec3 torque_V = Vec3::Zero();  ///< N m; travels in steps of 0.1 mN m, up to 3.2767 N m
};
/// A force that is not finite travels as zero, with the motors off.
std::array<std::uint8_t, VectorCommand::kBytes> encode(const VectorCommand& command);
/// The longer report. A torque that is not finite is as a force that is not.
std::array<std::uint8_t, VectorCommand::kBytesWithTorque> encode_with_torque(
    const VectorCommand& command);

struct VectorState {
  static constexpr std::size_t kBytes = 30;
  static constexpr std::uint8_t kId = 0x02;
  enum Status : std::uint8_t {
    kMotorsOn = 0x01,
    kTimedOut = 0x02,  ///< no report for 20 ms: the force is zero
    kHomed = 0x04,
    kTooWarm = 0x08,
    kFault = 0x10,
    kDeadManOpen = 0x20,  ///< the firmware's own dead-man switch is not held
  };
  static constexpr std::uint8_t kReservedStatus = 0xC0;

  std::uint8_t status = 0;
  std::uint16_t sequence = 0;
  std::uint16_t applied = 0;  ///< sequence of the command that the motors follow
  std::uint32_t time_us = 0;  ///< device's clock at the reading; wraps
  Vec3 p_V = Vec3::Zero();    ///< m; travels in steps of 0.1 um
  double turn_rad = 0;        ///< about V's z, in (-pi, pi]; travels as 1/65536 turn
  std::uint16_t buttons = 0;
  std::uint8_t instrument = 0;  ///< code of the handle in use; 0: none is recognised
  double motor_heat = -1;       ///< share of the limit; below 0: not known
};
/// False: short, of another kind, its CRC wrong or a reserved bit set; `state` is then untouched.
bool decode(std::span<const std::uint8_t> report, VectorState& state);

}  // namespace osteon
