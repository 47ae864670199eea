#pragma once

#include <cstdint>
#include <string>

namespace osteon {

/// A hash as a report shows it: 16 hexadecimal digits. JSON's own numbers do not hold 64 bits.
inline std::string hex16(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 0xf];
  return text;
}

}  // namespace osteon
