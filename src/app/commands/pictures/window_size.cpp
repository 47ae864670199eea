#include "commands/pictures/window_size.h"

#include <regex>

namespace osteon {

bool parse_window_size(const std::string& text, int& width, int& height) {
  static const std::regex pattern(R"((\d{3,5})x(\d{3,5}))");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return false;
  const int w = std::stoi(match[1]), h = std::stoi(match[2]);
  if (w < 640 || h < 400 || w > 8192 || h > 8192) return false;
  width = w;
  height = h;
  return true;
}

}  // namespace osteon
