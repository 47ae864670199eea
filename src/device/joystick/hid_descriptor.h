#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// HID usage: page in the upper 16 bits, as in the HID Usage Tables.
constexpr std::uint32_t hid_usage(std::uint16_t page, std::uint16_t id) {
  return (std::uint32_t{page} << 16) | id;
}

enum class HidReport : std::uint8_t { kInput, kOutput, kFeature };

/// One value in a report. Offsets count from the report's first byte as it travels: the report ID
/// when the device uses such.
struct HidField {
  HidReport report = HidReport::kInput;
  std::uint8_t report_id = 0;    ///< 0: the device uses none
  std::uint32_t usage = 0;       ///< of a variable; of an array the first that it can name
  std::uint32_t last_usage = 0;  ///< of an array the last that it can name in a row from the first
  bool is_array = false;         ///< its value names a usage: logical_min names the first
  std::uint32_t bit_offset = 0;
  std::uint32_t bits = 0;  ///< 1-32
  std::int64_t logical_min = 0;
  std::int64_t logical_max = 0;
  std::array<std::uint32_t, 8> collections{};  ///< usages from the outermost in
  std::size_t depth = 0;                       ///< how many of them

  bool inside(std::uint32_t collection) const;
  bool in_range(std::int64_t value) const { return value >= logical_min && value <= logical_max; }
};

/// What a report descriptor says (HID 1.11, section 6.2.2).
struct HidReports {
  std::vector<HidField> fields;  ///< in the descriptor's order; padding is left out
  bool uses_ids = false;

  /// First field of that usage (an array: one that can name it) within a collection of that usage.
  const HidField* find(HidReport report, std::uint32_t collection, std::uint32_t usage) const;
  /// Bytes of a report as it travels, its ID included; 0 when there is no such report.
  std::size_t bytes(HidReport report, std::uint8_t id) const;

  std::array<std::array<std::uint32_t, 256>, 3> bits{};  ///< of each report, with its ID
};

/// Reads a report descriptor. Any bytes are safe: sizes, counts and depth are bounded, and what is
/// outside the bounds or the standard fails with its place.
Result<HidReports> parse_hid_descriptor(std::span<const std::uint8_t> descriptor);

/// Value of the field in a report; sign-extended when its range goes below zero. 0 when the report
/// is too short for it.
std::int64_t read_field(std::span<const std::uint8_t> report, const HidField& field);
/// Puts the value's low bits in place; nothing when the report is too short for it.
void write_field(std::span<std::uint8_t> report, const HidField& field, std::int64_t value);
/// Value that names `usage` in an array field (see find).
std::int64_t array_value(const HidField& field, std::uint32_t usage);

}  // namespace osteon
