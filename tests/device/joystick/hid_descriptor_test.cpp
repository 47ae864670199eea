#include "joystick/hid_descriptor.h"

#include <gtest/gtest.h>

#include <vector>

#include "emulated/joystick_descriptors.h"
#include "joystick/pid_layout.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(HidDescriptor, BootMouseOfTheStandard) {
  // HID 1.11, appendix E.10: three buttons, five bits of padding, X and Y.
  const Bytes mouse = {0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x09, 0x01, 0xA1, 0x00, 0x05, 0x09, 0x19,
                       0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02,
                       0x95, 0x01, 0x75, 0x05, 0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
                       0x81, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xC0, 0xC0};
  const auto reports = parse_hid_descriptor(mouse);
  ASSERT_TRUE(reports) << reports.error().message();
  EXPECT_FALSE(reports->uses_ids);
  EXPECT_EQ(reports->bytes(HidReport::kInput, 0), 3u);
  ASSERT_EQ(reports->fields.size(), 5u);
  const HidField* y = reports->find(HidReport::kInput, hid_usage(1, 2), hid_usage(1, 0x31));
  ASSERT_NE(y, nullptr);
  EXPECT_EQ(y->bit_offset, 16u);
  EXPECT_EQ(y->logical_min, -127);
  EXPECT_EQ(read_field(Bytes{0, 0, 0x80}, *y), -128);
  EXPECT_FALSE(y->in_range(-128));
  const HidField* third = reports->find(HidReport::kInput, hid_usage(1, 1), hid_usage(9, 3));
  ASSERT_NE(third, nullptr);
  EXPECT_EQ(read_field(Bytes{0x04, 0, 0}, *third), 1);
  EXPECT_EQ(read_field(Bytes{}, *third), 0);
}

TEST(HidDescriptor, PidJoystickHasTheUsualLayout) {
  const auto reports = parse_hid_descriptor(pid_joystick_descriptors().report);
  ASSERT_TRUE(reports) << reports.error().message();
  const struct {
    HidReport kind;
    std::uint8_t id;
    std::size_t bytes;
  } usual[] = {
      {HidReport::kInput, 1, 10},  {HidReport::kInput, 2, 3},   {HidReport::kOutput, 1, 21},
      {HidReport::kOutput, 5, 4},  {HidReport::kOutput, 10, 4}, {HidReport::kOutput, 11, 2},
      {HidReport::kOutput, 12, 2}, {HidReport::kOutput, 13, 2}, {HidReport::kFeature, 5, 4},
      {HidReport::kFeature, 6, 5}, {HidReport::kFeature, 7, 5}};
  for (const auto& u : usual)
    EXPECT_EQ(reports->bytes(u.kind, u.id), u.bytes) << static_cast<int>(u.id);
  const HidField* magnitude =
      reports->find(HidReport::kOutput, pid::kSetConstantForce, pid::kMagnitude);
  ASSERT_NE(magnitude, nullptr);
  EXPECT_EQ(magnitude->bit_offset, 16u);
  EXPECT_EQ(magnitude->bits, 16u);
  EXPECT_EQ(magnitude->logical_min, -10000);
  EXPECT_EQ(magnitude->logical_max, 10000);
  const HidField* success = reports->find(HidReport::kFeature, pid::kBlockLoad, pid::kLoadFull);
  ASSERT_NE(success, nullptr);
  EXPECT_EQ(array_value(*success, pid::kLoadFull), 2);
  const HidField* reset = reports->find(HidReport::kOutput, pid::kControl, pid::kReset);
  ASSERT_NE(reset, nullptr);
  EXPECT_EQ(array_value(*reset, pid::kReset), 4);
  const HidField* y = reports->find(HidReport::kOutput, pid::kAxesEnable, hid_usage(1, 0x31));
  ASSERT_NE(y, nullptr);
  EXPECT_EQ(y->bit_offset, 13u * 8 + 1);
}

TEST(HidDescriptor, AMaximumWithoutSignOnlyWhereTheMinimumHasNone) {
  const Bytes d = {0x05, 0x01, 0x15, 0x00, 0x25, 0xFF, 0x75, 0x08, 0x95, 0x01, 0x09,
                   0x30, 0x81, 0x02, 0x15, 0x80, 0x25, 0x7F, 0x09, 0x31, 0x81, 0x02};
  const auto reports = parse_hid_descriptor(d);
  ASSERT_TRUE(reports);
  EXPECT_EQ(reports->fields[0].logical_max, 255);
  EXPECT_EQ(read_field(Bytes{0xFF, 0xFF}, reports->fields[0]), 255);
  EXPECT_EQ(read_field(Bytes{0xFF, 0xFF}, reports->fields[1]), -1);
}

TEST(HidDescriptor, BrokenOnesAreRefusedWithTheirPlace) {
  const struct {
    Bytes bytes;
    const char* what;
  } broken[] = {
      {{}, "no field"},
      {{0x05}, "cut short"},
      {{0xFE, 0x04, 0x00, 0x01}, "long item"},
      {{0x0C}, "reserved"},
      {{0xC0}, "not open"},
      {{0xA1, 0x01}, "not closed"},
      {{0xB4}, "popped"},
      {{0x85, 0x00}, "report ID"},
      {{0x29, 0x03}, "usage maximum"},
      {{0x19, 0x05, 0x29, 0x03}, "range of usages"},
      {{0x09, 0x30, 0x75, 0x28, 0x95, 0x01, 0x81, 0x02}, "wider"},
      {{0x09, 0x30, 0x75, 0x20, 0x96, 0xFF, 0x0F, 0x81, 0x02}, "too long"},
      {{0x09, 0x30, 0x77, 0xFF, 0xFF, 0xFF, 0xFF, 0x95, 0x02, 0x81, 0x02}, "too long"},
      {{0x15, 0x05, 0x25, 0x01, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02}, "range is empty"},
      {Bytes(18, 0xA1), "nested"},
      {Bytes(4097, 0x00), "4096"},
  };
  for (const auto& b : broken) {
    const auto reports = parse_hid_descriptor(b.bytes);
    ASSERT_FALSE(reports) << b.what;
    EXPECT_NE(reports.error().what.find(b.what), std::string::npos) << reports.error().message();
  }
}

TEST(HidDescriptor, FieldsOfEverySizeAndPlaceReadBack) {
  Random random(5);
  for (int k = 0; k < 5000; ++k) {
    HidField f;
    f.bits = 1 + static_cast<std::uint32_t>(random.next() % 32);
    f.bit_offset = static_cast<std::uint32_t>(random.next() % 40);
    f.logical_min = (random.next() & 1) != 0 ? -1 : 0;
    Bytes report(12);
    for (auto& b : report) b = static_cast<std::uint8_t>(random.next());
    const Bytes before = report;
    const auto value =
        static_cast<std::int64_t>(random.next() & ((std::uint64_t{1} << f.bits) - 1));
    write_field(report, f, value);
    const std::int64_t top = std::int64_t{1} << (f.bits - 1);
    const std::int64_t expected = f.logical_min < 0 && value >= top ? value - 2 * top : value;
    ASSERT_EQ(read_field(report, f), expected);
    for (std::uint32_t bit = 0; bit < 96; ++bit) {
      if (bit >= f.bit_offset && bit < f.bit_offset + f.bits) continue;
      ASSERT_EQ(report[bit / 8] >> (bit % 8) & 1, before[bit / 8] >> (bit % 8) & 1);
    }
  }
}

}  // namespace
}  // namespace osteon
