#include "falcon/falcon_packet.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {
namespace {

std::string text(const FalconPacket& p) { return {p.begin(), p.end()}; }

TEST(FalconPacket, BytesAreThoseOfTheProtocol) {
  FalconCommand command;
  EXPECT_EQ(text(encode(command)), "<AAAAAAAAAAAAAA>");
  command.motors = {0x1234, -1, -4096};  // lowest nibble first, each + 'A'
  command.homing = true;
  command.lights = kFalconRed | kFalconGreen;
  EXPECT_EQ(text(encode(command)), "<EDCBPPPPAAAPLA>");
  FalconReport report;
  report.encoders = {1, -2, 32767};
  report.homed = 5;
  report.grip = 9;
  FalconPacket p = encode(report);
  EXPECT_EQ(text(p).substr(0, 13), "<BAAAOPPPPPPH");
  EXPECT_EQ(p[13], 0x41 + (5 << 4 | 9));
}

TEST(FalconPacket, EveryNumberComesBack) {
  for (int n = -32768; n <= 32767; ++n) {
    FalconReport report;
    report.encoders = {n, -1 - n, n ^ 0x55};
    report.homed = static_cast<std::uint8_t>(n & 7);
    report.grip = static_cast<std::uint8_t>(n >> 3 & 0xF);
    const FalconReport back = decode_report(encode(report));
    ASSERT_EQ(back.encoders, report.encoders);
    ASSERT_EQ(back.homed, report.homed);
    ASSERT_EQ(back.grip, report.grip);
  }
  FalconCommand command{{-4096, 0, 4096}, true, kFalconBlue};
  const FalconCommand back = decode_command(encode(command));
  EXPECT_EQ(back.motors, command.motors);
  EXPECT_TRUE(back.homing);
  EXPECT_EQ(back.lights, kFalconBlue);
}

TEST(FalconPacket, ReaderFindsPacketsAfterNoiseAndCuts) {
  FalconReport report;
  report.encoders = {-1463, 200, 1056};
  const FalconPacket good = encode(report);
  std::vector<std::uint8_t> stream{'>', 'A', 0xFF, '<', 'A', 'A'};  // noise, then a cut packet
  stream.insert(stream.end(), good.begin(), good.end());
  stream.insert(stream.end(), good.begin(), good.begin() + 9);  // cut by the next
  stream.insert(stream.end(), good.begin(), good.end());
  FalconPacketReader reader;
  int found = 0;
  for (const std::uint8_t byte : stream)
    if (reader.feed(byte)) {
      ++found;
      EXPECT_EQ(decode_report(reader.packet()).encoders, report.encoders);
    }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(reader.broken(), 2u);
}

TEST(FalconPacket, AnyBytesMayCome) {
  Random random(7);
  FalconPacketReader reader;
  std::uint64_t found = 0;
  for (int n = 0; n < 3'000'000; ++n) {
    // Mostly bytes that could belong to a packet: others end one at once.
    const std::uint64_t r = random.next();
    const bool likely = (r & 0xF) != 0;
    const auto byte = static_cast<std::uint8_t>(likely ? 'A' + (r >> 8 & 0xF) : r >> 8);
    const std::uint8_t fed = (r >> 16 & 15) == 0 ? '<' : (r >> 16 & 15) == 1 ? '>' : byte;
    if (!reader.feed(fed)) continue;
    ++found;
    // Whatever was taken for a packet is one: it encodes back to its bytes.
    FalconPacket again = encode(decode_report(reader.packet()));
    again[14] = reader.packet()[14];
    ASSERT_EQ(again, reader.packet());
  }
  EXPECT_GT(found, 100u);
  EXPECT_GT(reader.broken(), 1000u);
}

}  // namespace
}  // namespace osteon
