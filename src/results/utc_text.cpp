#include "utc_text.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>

namespace osteon {

std::string utc_text(std::int64_t ms) {
  using namespace std::chrono;
  const sys_time<milliseconds> at{milliseconds(ms)};
  const auto day = floor<days>(at);
  const year_month_day date(day);
  const hh_mm_ss<milliseconds> time(at - day);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", int(date.year()),
                unsigned(date.month()), unsigned(date.day()), int(time.hours().count()),
                int(time.minutes().count()), int(time.seconds().count()),
                int(time.subseconds().count()));
  return text;
}

std::string duration_text(double seconds) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, std::max(0.0, seconds),
                                 std::chars_format::fixed, 2)
                       .ptr;
  return "PT" + std::string(digits, end) + "S";
}

}  // namespace osteon
