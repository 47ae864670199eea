#pragma once

#include <filesystem>

#include "checkup/finding.h"

namespace osteon {

/// Runs a real 1 kHz loop with whatever priority this user gets: rate, lateness, missed ticks; and
/// the limits (rtprio, memlock) that decide on it.
Findings realtime_findings(double seconds);

/// OpenGL, as the window would get it.
Finding gl_finding();

/// Whether this user may open USB devices, and the rule for it where not.
Findings usb_findings();

inline constexpr const char* kUdevFolder = "/etc/udev/rules.d";
inline constexpr const char* kUdevFile = "70-osteon.rules";

/// Writes the rule; says what became of it.
Finding install_udev_rule(const std::filesystem::path& folder);

}  // namespace osteon
