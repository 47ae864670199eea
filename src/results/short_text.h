#pragma once

#include <cstddef>
#include <string>

namespace osteon {

/// At most so many bytes of a text in UTF-8, with no character cut in two.
inline std::string short_text(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return text.substr(0, most);
}

}  // namespace osteon
