#pragma once

#include <string_view>

namespace osteon {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Writes one line to standard error (and to the file set below). Never from the haptic tick.
void log(LogLevel level, std::string_view message);
/// Lines below `level` are dropped. Default: kInfo.
void set_log_level(LogLevel level);

}  // namespace osteon
