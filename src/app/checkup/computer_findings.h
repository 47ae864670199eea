#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "checkup/finding.h"

namespace osteon {

/// Runs a real 1 kHz loop with whatever priority this user gets: rate, lateness, missed ticks; and
/// the limits (rtprio, memlock) that decide on it. `cancelled`, asked at each tick, ends it early.
Findings realtime_findings(double seconds, const std::function<bool()>& cancelled = {});

/// OpenGL, as the window would get it.
Finding gl_finding();
/// The same of a context that somebody has already.
Finding gl_finding(const std::string& version, const std::string& renderer);

/// Whether this user may open USB devices, and the rule for it where not.
Findings usb_findings();

inline constexpr const char* kUdevFolder = "/etc/udev/rules.d";
inline constexpr const char* kUdevFile = "70-osteon.rules";

/// Writes the rule; says what became of it.
Finding install_udev_rule(const std::filesystem::path& folder);

/// The udev rule on this computer.
struct UdevRule {
  std::string text;          ///< of the file; empty when the profiles are not to be found
  bool installed = false;    ///< in `folder`, or where a package would put it
  bool may_install = false;  ///< this user may write `folder`
};
UdevRule udev_rule(const std::filesystem::path& folder = kUdevFolder);

}  // namespace osteon
