#include "chunk.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include "record_fixtures.h"

namespace osteon {
namespace {

using testing::expect_same;
using testing::step_record;
using testing::tick_record;

constexpr std::size_t kTickBytes = (25 + kMaxHands) * 8;

std::vector<TickRecord> some_ticks(std::uint64_t first, std::size_t count) {
  std::vector<TickRecord> ticks;
  for (std::uint64_t i = 0; i < count; ++i) ticks.push_back(tick_record(first + i));
  return ticks;
}

std::string frame_of_size(std::size_t bytes, char fill) {
  const std::string raw(bytes, fill);
  std::string frame(ZSTD_compressBound(bytes), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), raw.data(), raw.size(), 1));
  return frame;
}

TEST(Chunk, RefusesCountsThatItCannotHave) {
  std::vector<TickRecord> ticks;
  EXPECT_FALSE(decode_chunk(frame_of_size(0, 0), 1, 0, ticks));
  EXPECT_FALSE(decode_chunk(frame_of_size(251 * kTickBytes, 0), 1, 251, ticks));
  EXPECT_FALSE(decode_chunk(frame_of_size(kTickBytes, 0), 1, std::size_t{1} << 60, ticks));
  EXPECT_TRUE(ticks.empty());
}

TEST(Chunk, RefusesASizeThatIsNotThatOfItsCount) {
  std::vector<TickRecord> ticks;
  EXPECT_TRUE(decode_chunk(frame_of_size(2 * kTickBytes, 0), 1, 2, ticks));
  EXPECT_FALSE(decode_chunk(frame_of_size(2 * kTickBytes + 1, 0), 1, 2, ticks));
  EXPECT_FALSE(decode_chunk(frame_of_size(2 * kTickBytes - 1, 0), 1, 2, ticks));
  // A small frame that would fill the memory: refused by its stated size.
  EXPECT_FALSE(decode_chunk(frame_of_size(std::size_t{64} << 20, 0), 1, 250, ticks));
}

TEST(Chunk, RefusesWhatIsNoFrame) {
  std::vector<TickRecord> ticks;
  EXPECT_FALSE(decode_chunk("", 1, 1, ticks));
  EXPECT_FALSE(decode_chunk("not a frame", 1, 1, ticks));
  const std::string whole = encode_chunk(some_ticks(1, 10));
  for (std::size_t cut = 0; cut < whole.size(); cut += 7)
    EXPECT_FALSE(decode_chunk(std::string_view(whole).substr(0, cut), 1, 10, ticks)) << cut;
}

TEST(Chunk, RefusesFieldsOutOfRange) {
  // All bytes 0xff in the first record: buttons, command and status cannot hold them.
  std::vector<TickRecord> ticks;
  EXPECT_FALSE(decode_chunk(frame_of_size(kTickBytes, '\xff'), 1, 1, ticks));
  std::vector<StepRecord> steps;
  EXPECT_FALSE(decode_chunk(frame_of_size(3 * 8, '\xff'), 1, 1, steps));
}

TEST(Chunk, TicksComeBackBitByBit) {
  for (const std::size_t count : {1, 2, 97, 250}) {
    const auto ticks = some_ticks(41, count);
    std::vector<TickRecord> back;
    const auto done = decode_chunk(encode_chunk(ticks), 41, count, back);
    ASSERT_TRUE(done) << done.error().message();
    ASSERT_EQ(back.size(), count);
    for (std::size_t i = 0; i < count; ++i) expect_same(back[i], ticks[i]);
  }
}

TEST(Chunk, StepsComeBackAndAreAppended) {
  std::vector<StepRecord> steps;
  for (std::uint64_t n = 1; n <= 40; ++n) steps.push_back(step_record(n));
  std::vector<StepRecord> back{step_record(0)};
  ASSERT_TRUE(decode_chunk(encode_chunk(steps), 1, 40, back));
  ASSERT_EQ(back.size(), 41u);
  for (std::size_t i = 0; i < 40; ++i) expect_same(back[i + 1], steps[i]);
}

TEST(Chunk, TheFileFormatDoesNotDrift) {
  // A byte written today must be read for ever: these are the raw words of two steps, in order.
  std::vector<StepRecord> steps(2);
  steps[0] = {1, {0x0102}, {CommandKind::kHoldBones, 1.0}};
  steps[1] = {2, {0x0103}, {CommandKind::kNone, 0.0}};
  const std::string frame = encode_chunk(steps);
  // Of each field 8 bytes of both steps: four hands' ticks, the command's kind and its value.
  constexpr std::size_t kBytes = 6 * 16;
  std::string raw(kBytes, '\0');
  ASSERT_EQ(ZSTD_decompress(raw.data(), raw.size(), frame.data(), frame.size()), kBytes);
  std::string expected(kBytes, '\0');
  expected[0] = 0x02;  // tool_ticks[0]: byte 0 of 0x0102, then of 0x0102 ^ 0x0103
  expected[1] = 0x01;
  expected[2] = 0x01;                              // byte 1 of 0x0102, then 0
  expected[64] = expected[65] = 3;                 // command's kind, then 3 ^ 0
  expected[80 + 12] = expected[80 + 13] = '\xf0';  // 1.0 = 0x3ff0000000000000
  expected[80 + 14] = expected[80 + 15] = 0x3f;
  EXPECT_EQ(raw, expected);
}

TEST(Chunk, SlowMovementPacksWell) {
  // A hand that rests on bone: only the last bits of its position change.
  std::vector<TickRecord> ticks(250);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    ticks[i].input.X_WD.p = {0.1 + 1e-9 * double(i), 0.2, 0.3};
    ticks[i].bone_step = i / 2;
  }
  EXPECT_LT(encode_chunk(ticks).size(), 250 * kTickBytes / 20);
}

TEST(Chunk, TheChecksumCoversPlaceAndData) {
  const std::string frame = encode_chunk(some_ticks(1, 3));
  const std::uint64_t sum = chunk_checksum(frame, 1, 3);
  EXPECT_NE(sum, chunk_checksum(frame, 2, 3));
  EXPECT_NE(sum, chunk_checksum(frame, 1, 4));
  std::string other = frame;
  other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 1);
  EXPECT_NE(sum, chunk_checksum(other, 1, 3));
}

}  // namespace
}  // namespace osteon
