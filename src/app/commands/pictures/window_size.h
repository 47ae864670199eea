#pragma once

#include <string>

namespace osteon {

/// Reads "1280x720", from 640x400 to 8192x8192. False, and nothing set, for anything else.
bool parse_window_size(const std::string& text, int& width, int& height);

}  // namespace osteon
