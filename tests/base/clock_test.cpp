#include "osteon/base/clock.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Clock, NeverRunsBack) {
  std::int64_t last = steady_now_ns();
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now = steady_now_ns();
    ASSERT_GE(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace osteon
