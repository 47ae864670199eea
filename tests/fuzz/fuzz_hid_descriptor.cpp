// Any bytes as a HID report descriptor: an error, or fields that lie within their reports.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../src/device/joystick/hid_descriptor.h"
#include "osteon/base/check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto reports = osteon::parse_hid_descriptor({data, size});
  if (!reports) return 0;
  for (const osteon::HidField& field : reports->fields) {
    std::vector<std::uint8_t> report(reports->bytes(field.report, field.report_id));
    osteon::demand(field.bit_offset + field.bits <= 8 * report.size(), "a field leaves its report");
    osteon::demand(field.logical_min <= field.logical_max, "a range is empty");
    osteon::write_field(report, field, -1);
    const std::int64_t ones = osteon::read_field(report, field);
    const std::int64_t all = (std::int64_t{1} << field.bits) - 1;
    osteon::demand(ones == (field.logical_min < 0 ? -1 : all), "a field reads what is not in it");
    osteon::write_field(report, field, 0);
    for (const std::uint8_t byte : report) osteon::demand(byte == 0, "a field spills over");
  }
  return 0;
}
