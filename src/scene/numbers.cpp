#include "numbers.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace osteon {

std::string format_number(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string out(text, end);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";
  return out;
}

std::string in_mm(double metres) {
  char text[32];
  const double mm = metres * 1000;
  std::snprintf(text, sizeof text, std::abs(mm) < 1000 ? "%.3g mm" : "%.0f mm", mm);
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<Quat> as_unit(const Quat& q) {
  const double squared = q.squaredNorm();
  if (!(std::abs(squared - 1) <= 2e-3)) return {};
  if (std::abs(squared - 1) <= 1e-15) return q;
  Quat unit = q;
  unit.coeffs() /= std::sqrt(squared);
  return unit;
}

}  // namespace osteon
