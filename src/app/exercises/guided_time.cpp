#include "exercises/guided_time.h"

#include <charconv>
#include <cmath>

namespace osteon {

std::string guided_text(double seconds) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, seconds).ptr;
  return std::string(text, end) + " s\n";
}

Result<double> parse_guided(std::string_view text, const std::string& where) {
  if (text.empty()) return 0.0;
  double seconds = 0;
  const char* const last = text.data() + text.size();
  const auto [end, ec] = std::from_chars(text.data(), last, seconds);
  if (ec != std::errc() || !std::isfinite(seconds) || seconds < 0 ||
      std::string_view(end, static_cast<std::size_t>(last - end)) != " s\n")
    return fail("its note about guidance is damaged", where, "Use another copy of the file");
  return seconds;
}

}  // namespace osteon
