#include "runs/replays/path_commands.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "osteon/scene/tool_set.h"
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

namespace {

// A tray may write the same size otherwise: 3.0 for 3.
std::optional<std::uint32_t> place_in(std::span<const std::string> tray, const std::string& name) {
  const auto wanted = parse_tool_name(name);
  for (std::size_t i = 0; i < tray.size(); ++i) {
    const auto there = parse_tool_name(tray[i]);
    const bool same =
        wanted && there && there->name == wanted->name && there->size_mm == wanted->size_mm;
    if (same || tray[i] == name) return static_cast<std::uint32_t>(i);
  }
  return std::nullopt;
}

}  // namespace

PathCommands::PathCommands(const ProbePath& path, std::span<const std::string> tray)
    : path_(path), tray_(tray.begin(), tray.end()) {
  const bool named = !path.samples.empty() && !path.samples.front().instrument.empty();
  const std::string first = named ? tray_name(path.samples.front()) : kWristProbe;
  held_ = place_in(tray_, first).value_or(held_);
}

std::uint32_t PathCommands::place_of(const PathSample& sample) const {
  if (sample.instrument.empty()) return held_;
  return place_in(tray_, tray_name(sample)).value_or(held_);
}

Command PathCommands::at(double time_s) {
  if (!path_.with_instruments) return {};
  const PathSample sample = path_.at(time_s);
  if (const std::uint32_t wanted = place_of(sample); wanted != held_) {
    held_ = wanted;
    drive_.took();
    return {CommandKind::kTake, static_cast<double>(wanted)};
  }
  return drive_.next(sample);
}

}  // namespace osteon
