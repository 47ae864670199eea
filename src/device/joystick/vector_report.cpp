#include "vector_report.h"

#include <algorithm>
#include <cmath>

#include "angles.h"

namespace osteon {
namespace {

void put_u16(std::uint8_t* at, std::uint16_t value) {
  at[0] = static_cast<std::uint8_t>(value);
  at[1] = static_cast<std::uint8_t>(value >> 8);
}

std::uint16_t get_u16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] | (at[1] << 8));
}

std::uint32_t get_u32(const std::uint8_t* at) {
  return get_u16(at) | (std::uint32_t{get_u16(at + 2)} << 16);
}

// As a signed number of `steps` to the unit, at its bound where it is larger.
void put_steps(std::uint8_t* at, const Vec3& v, double steps) {
  for (int i = 0; i < 3; ++i) {
    const double n = std::clamp(std::round(v[i] * steps), -32767.0, 32767.0);
    put_u16(at + 2 * i, static_cast<std::uint16_t>(static_cast<std::int16_t>(n)));
  }
}

constexpr double kForceSteps = 1e3;   // to the newton
constexpr double kTorqueSteps = 1e4;  // to the newton metre

// What all commands begin with; without power where what follows is not finite.
void put_head(std::uint8_t* at, std::uint8_t id, const VectorCommand& command, bool finite) {
  at[0] = id;
  at[1] =
      finite ? command.flags : static_cast<std::uint8_t>(command.flags & ~VectorCommand::kMotorsOn);
  put_u16(at + 2, command.sequence);
}

}  // namespace

std::uint16_t crc16_ccitt(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<std::uint32_t>(byte) << 8;
    for (int i = 0; i < 8; ++i) crc = (crc & 0x8000) != 0 ? (crc << 1) ^ 0x1021 : crc << 1;
    crc &= 0xFFFF;
  }
  return static_cast<std::uint16_t>(crc);
}

std::array<std::uint8_t, VectorCommand::kBytes> encode(const VectorCommand& command) {
  std::array<std::uint8_t, VectorCommand::kBytes> report{};
  const bool finite = is_finite(command.force_V);
  put_head(report.data(), VectorCommand::kId, command, finite);
  if (finite) put_steps(&report[4], command.force_V, kForceSteps);
  put_u16(&report[10], crc16_ccitt({report.data(), 10}));
  return report;
}

std::array<std::uint8_t, VectorCommand::kBytesWithTorque> encode_with_torque(
    const VectorCommand& command) {
  std::array<std::uint8_t, VectorCommand::kBytesWithTorque> report{};
  const bool finite = is_finite(command.force_V) && is_finite(command.torque_V);
  put_head(report.data(), VectorCommand::kIdWithTorque, command, finite);
  if (finite) {
    put_steps(&report[4], command.force_V, kForceSteps);
    put_steps(&report[10], command.torque_V, kTorqueSteps);
  }
  put_u16(&report[16], crc16_ccitt({report.data(), 16}));
  return report;
}

bool decode(std::span<const std::uint8_t> report, VectorState& state) {
  if (report.size() != VectorState::kBytes || report[0] != VectorState::kId) return false;
  if (get_u16(&report[28]) != crc16_ccitt(report.first(28))) return false;
  if ((report[1] & VectorState::kReservedStatus) != 0) return false;
  state.status = report[1];
  state.sequence = get_u16(&report[2]);
  state.applied = get_u16(&report[4]);
  state.time_us = get_u32(&report[6]);
  for (int i = 0; i < 3; ++i) {
    const std::size_t at = 10 + 4 * static_cast<std::size_t>(i);
    state.p_V[i] = 1e-7 * static_cast<std::int32_t>(get_u32(&report[at]));
  }
  state.turn_rad = static_cast<std::int16_t>(get_u16(&report[22])) * (kTurn_rad / 65536);
  state.buttons = get_u16(&report[24]);
  state.instrument = report[27];
  state.motor_heat = report[26] == 0xFF ? -1 : report[26] / 100.0;
  return true;
}

}  // namespace osteon
