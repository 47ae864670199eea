#include "runs/replays/path_commands.h"

#include <algorithm>
#include <cstdio>

#include "runs/hands/tray.h"

namespace osteon {

std::string tray_name(const PathSample& sample) {
  if (!(sample.size_mm > 0)) return sample.instrument;
  char size[32];
  std::snprintf(size, sizeof size, ":%g", sample.size_mm);
  return sample.instrument + size;
}

std::vector<std::string> instruments_of(const ProbePath& path) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (path.samples.empty() || path.samples.front().instrument.empty()) add(kWristProbe);
  for (const PathSample& sample : path.samples)
    if (!sample.instrument.empty()) add(tray_name(sample));
  return names;
}

PathCommands::PathCommands(const ProbePath& path, std::span<const std::string> tray)
    : path_(path), tray_(tray.begin(), tray.end()) {
  const bool named = !path.samples.empty() && !path.samples.front().instrument.empty();
  const std::string first = named ? tray_name(path.samples.front()) : kWristProbe;
  const auto found = std::find(tray_.begin(), tray_.end(), first);
  if (found != tray_.end()) held_ = static_cast<std::uint32_t>(found - tray_.begin());
}

std::uint32_t PathCommands::place_of(const PathSample& sample) const {
  if (sample.instrument.empty()) return held_;
  const auto found = std::find(tray_.begin(), tray_.end(), tray_name(sample));
  return found == tray_.end() ? held_ : static_cast<std::uint32_t>(found - tray_.begin());
}

Command PathCommands::at(double time_s) {
  if (!path_.with_instruments) return {};
  const PathSample sample = path_.at(time_s);
  if (const std::uint32_t wanted = place_of(sample); wanted != held_) {
    held_ = wanted;
    power_ = jaw_ = 0;  // as one takes it
    return {CommandKind::kTake, static_cast<double>(wanted)};
  }
  if (sample.power != power_) {
    power_ = sample.power;
    return {CommandKind::kPower, power_};
  }
  if (sample.jaw != jaw_) {
    jaw_ = sample.jaw;
    return {CommandKind::kJaw, jaw_};
  }
  return {};
}

}  // namespace osteon
