#include "exercises/guided_time.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(GuidedTime, ComesBackToTheBit) {
  for (const double seconds : {0.0, 0.1, 12.25, 1e-9, 3599.999}) {
    const auto read = parse_guided(guided_text(seconds), "x.osr");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(*read, seconds);
  }
  EXPECT_EQ(parse_guided("", "x.osr").value(), 0);
}

TEST(GuidedTime, DamageIsToldWithTheFile) {
  for (const char* bad : {" ", "12", "s", "-1 s\n", "nan s\n", "inf s\n", "1 s\n2 s\n", "1s\n"}) {
    const auto read = parse_guided(bad, "x.osr");
    ASSERT_FALSE(read) << bad;
    EXPECT_NE(read.error().message().find("x.osr"), std::string::npos);
  }
}

}  // namespace
}  // namespace osteon
