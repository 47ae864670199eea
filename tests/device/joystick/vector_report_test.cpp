#include "joystick/vector_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace osteon {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(VectorReport, CrcHasThePublishedCheckValue) {
  const char* text = "123456789";
  EXPECT_EQ(crc16_ccitt({reinterpret_cast<const std::uint8_t*>(text), 9}), 0x29B1);
}

TEST(VectorReport, CommandIsByteForByteAsSpecified) {
  const auto report = encode({VectorCommand::kMotorsOn, 0x1234, Vec3(1.0, -2.5, 0.0004)});
  Bytes expected = {0x01, 0x01, 0x34, 0x12, 0xE8, 0x03, 0x3C, 0xF6, 0x00, 0x00};
  const std::uint16_t crc = crc16_ccitt(expected);
  expected.push_back(static_cast<std::uint8_t>(crc));
  expected.push_back(static_cast<std::uint8_t>(crc >> 8));
  EXPECT_EQ(Bytes(report.begin(), report.end()), expected);
}

TEST(VectorReport, ForceIsClampedAndNeverNotANumber) {
  auto report = encode({VectorCommand::kMotorsOn, 1, Vec3(1e9, -1e9, 0)});
  EXPECT_EQ(report[4], 0xFF);
  EXPECT_EQ(report[5], 0x7F);
  EXPECT_EQ(report[6], 0x01);
  EXPECT_EQ(report[7], 0x80);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    report = encode({VectorCommand::kMotorsOn, 1, Vec3(5, bad, 0)});
    EXPECT_EQ(report[1], 0);
    for (std::size_t i = 4; i < 10; ++i) EXPECT_EQ(report[i], 0);
  }
}

Bytes sound_state() {
  Bytes b(30);
  b[0] = 0x02;
  b[1] = 0x05;
  b[2] = 0x07;                               // sequence 7
  b[4] = 0x06;                               // applied 6
  b[6] = 0x10, b[7] = 0x27;                  // 10 000 us
  b[10] = 0xA0, b[11] = 0x86, b[12] = 0x01;  // 100 000: 10 mm
  b[14] = b[15] = b[16] = b[17] = 0xFF;      // -1: -0.1 um
  b[23] = 0xC0;                              // -16384: a quarter turn back
  b[24] = 0x03;                              // two buttons
  b[26] = 50;
  b[27] = 12;
  const std::uint16_t crc = crc16_ccitt({b.data(), 28});
  b[28] = static_cast<std::uint8_t>(crc);
  b[29] = static_cast<std::uint8_t>(crc >> 8);
  return b;
}

TEST(VectorReport, StateIsReadAsSpecified) {
  VectorState state;
  ASSERT_TRUE(decode(sound_state(), state));
  EXPECT_EQ(state.status, VectorState::kMotorsOn | VectorState::kHomed);
  EXPECT_EQ(state.sequence, 7);
  EXPECT_EQ(state.applied, 6);
  EXPECT_EQ(state.time_us, 10000u);
  EXPECT_NEAR(state.p_V.x(), 0.010, 1e-12);
  EXPECT_NEAR(state.p_V.y(), -1e-7, 1e-15);
  EXPECT_EQ(state.p_V.z(), 0);
  EXPECT_NEAR(state.turn_rad, -std::acos(-1.0) / 2, 1e-12);
  EXPECT_EQ(state.buttons, 3);
  EXPECT_EQ(state.motor_heat, 0.5);
  EXPECT_EQ(state.instrument, 12);
}

TEST(VectorReport, EveryChangedBitAndEveryOtherLengthIsRefused) {
  VectorState state;
  state.sequence = 4711;
  const Bytes sound = sound_state();
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    Bytes b = sound;
    b[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    EXPECT_FALSE(decode(b, state)) << bit;
  }
  for (std::size_t n = 0; n < 64; ++n) {
    if (n == sound.size()) continue;
    Bytes b = sound;
    b.resize(n);
    EXPECT_FALSE(decode(b, state)) << n;
  }
  EXPECT_EQ(state.sequence, 4711);
}

}  // namespace
}  // namespace osteon
