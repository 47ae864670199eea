#pragma once

#include <cstdio>
#include <string>

namespace osteon {

/// A line of at most 255 bytes, as printf writes it.
template <class... Args>
std::string printed(const char* format, Args... args) {
  char out[256];
  std::snprintf(out, sizeof out, format, args...);
  return out;
}

}  // namespace osteon
