#include "text_header.h"

#include <charconv>
#include <cmath>

namespace osteon {

std::string trimmed(std::string_view text) {
  const char* blank = " \t\r\n";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(blank) - from + 1));
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> out;
  for (std::size_t at = 0;;) {
    at = text.find_first_not_of(" \t\r\n,()", at);
    if (at == std::string_view::npos) return out;
    if (text[at] == '+') ++at;
    double value = 0;
    const auto parsed = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
    out.push_back(value);
    at = static_cast<std::size_t>(parsed.ptr - text.data());
  }
}

std::optional<int> whole_number(double value) {
  if (!(std::abs(value) < 1e9) || value != std::floor(value)) return std::nullopt;
  return static_cast<int>(value);
}

}  // namespace osteon
