#include "osteon/base/clock.h"

#include <chrono>

namespace osteon {

std::int64_t steady_now_ns() {
  const auto t = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(t).count();
}

}  // namespace osteon
