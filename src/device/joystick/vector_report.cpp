#include "vector_report.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kTurn_rad = 6.283185307179586;

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

std::uint16_t millinewtons(double newtons) {
  const double steps = std::clamp(std::round(newtons * 1e3), -32767.0, 32767.0);
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(steps));
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
  report[0] = VectorCommand::kId;
  report[1] =
      finite ? command.flags : static_cast<std::uint8_t>(command.flags & ~VectorCommand::kMotorsOn);
  put_u16(&report[2], command.sequence);
  for (int i = 0; i < 3; ++i)
    put_u16(&report[4 + 2 * static_cast<std::size_t>(i)],
            millinewtons(finite ? command.force_V[i] : 0));
  put_u16(&report[10], crc16_ccitt({report.data(), 10}));
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
