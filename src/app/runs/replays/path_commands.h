#pragma once

#include <span>
#include <string>
#include <vector>

#include "osteon/scene/command.h"
#include "osteon/scene/path_drive.h"

namespace osteon {

/// "hook_probe" or "hook_probe:1.5": what a sample's hand takes, as the tray names it.
std::string tray_name(const PathSample& sample);
/// What a path's hand holds at its start, and all that it takes; each once.
std::vector<std::string> instruments_of(const ProbePath& path);

/// What a path says of instruments, power and jaws, as commands: one a tick.
class PathCommands {
 public:
  /// `tray` must hold instruments_of(path); empty: the wrist probe alone.
  PathCommands(const ProbePath& path, std::span<const std::string> tray);
  /// In the tray.
  std::uint32_t first_instrument() const { return held_; }
  /// Times come in order.
  Command at(double time_s);

 private:
  std::uint32_t place_of(const PathSample& sample) const;

  const ProbePath path_;
  std::vector<std::string> tray_;
  std::uint32_t held_ = 0;
  PathDrive drive_;
};

}  // namespace osteon
