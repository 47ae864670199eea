#include "numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(Numbers, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"", " ", "+", "-", "x", "1x", " 1", "1 ", "1,5", "nan", "inf", "-inf",
                           "1e999", "0x10", "+-1", "--1", "1e"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(Numbers, EveryBitPatternReadsBack) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random.next());
    if (!std::isfinite(value)) continue;
    const auto back = parse_number(format_number(value));
    ASSERT_TRUE(back) << format_number(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Numbers, WholeNumbersLookLikeFloats) {
  EXPECT_EQ(format_number(0), "0.0");
  EXPECT_EQ(format_number(-3), "-3.0");
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_NE(format_number(1e300).find('e'), std::string::npos);
}

TEST(Numbers, UnitQuaternionsSettleAfterOneScaling) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    Quat q = random.rotation();
    q.coeffs() *= random.uniform(0.9992, 1.0008);
    const auto once = as_unit(q);
    ASSERT_TRUE(once);
    EXPECT_NEAR(once->norm(), 1, 1e-15);
    EXPECT_EQ(as_unit(*once)->coeffs(), once->coeffs());
  }
  EXPECT_FALSE(as_unit(Quat(0, 0, 0, 0)));
  EXPECT_FALSE(as_unit(Quat(std::nan(""), 0, 0, 0)));
  EXPECT_FALSE(as_unit(Quat(1.01, 0, 0, 0)));
}

}  // namespace
}  // namespace osteon
