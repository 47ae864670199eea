#include "runs/hands/pedals.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kPress = 0.5, kRelease = 0.35;
constexpr double kMoved = 0.5;  // of an axis' range of 2: a pedal at rest wavers by far less

const ControllerReading* find(const PedalReadings& readings, const std::string& name) {
  for (const ControllerReading& stick : readings.joysticks)
    if (name.empty() || stick.name == name) return &stick;
  return nullptr;
}

double axis_value(const PedalSource& source, const ControllerReading& stick) {
  const auto index = static_cast<std::size_t>(source.index);
  if (source.index < 0 || index >= stick.axes.size()) return 0;
  const double way = source.full - source.rest;
  const double value = way != 0 ? (stick.axes[index] - source.rest) / way : 0;
  return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0;
}

// The newly pressed button of a stick, or its axis that went farthest.
std::optional<PedalSource> moved_part(const ControllerReading& rest, const ControllerReading& now) {
  for (std::size_t i = 0; i < std::min(rest.buttons.size(), now.buttons.size()); ++i)
    if (now.buttons[i] && !rest.buttons[i])
      return PedalSource{PedalKind::kButton, now.name, static_cast<int>(i), 0, 1};
  std::optional<PedalSource> best;
  double farthest = kMoved;
  for (std::size_t i = 0; i < std::min(rest.axes.size(), now.axes.size()); ++i) {
    const double way = now.axes[i] - rest.axes[i];
    if (!(std::abs(way) > farthest)) continue;
    farthest = std::abs(way);
    best = PedalSource{PedalKind::kAxis, now.name, static_cast<int>(i), rest.axes[i],
                       way > 0 ? 1.0 : -1.0};
  }
  return best;
}

}  // namespace

double pedal_value(const PedalSource& source, const PedalReadings& readings) {
  if (source.kind == PedalKind::kKey)
    return std::count(readings.keys.begin(), readings.keys.end(), source.index) > 0 ? 1 : 0;
  if (source.kind == PedalKind::kNone) return 0;
  const ControllerReading* stick = find(readings, source.joystick);
  if (!stick) return 0;
  if (source.kind == PedalKind::kAxis) return axis_value(source, *stick);
  const auto index = static_cast<std::size_t>(source.index);
  return source.index >= 0 && index < stick->buttons.size() && stick->buttons[index] ? 1 : 0;
}

std::optional<PedalSource> moved_input(const PedalReadings& rest, const PedalReadings& now) {
  for (const int key : now.keys)
    if (std::count(rest.keys.begin(), rest.keys.end(), key) == 0)
      return PedalSource{PedalKind::kKey, {}, key, 0, 1};
  for (const ControllerReading& stick : now.joysticks)
    if (const ControllerReading* before = find(rest, stick.name))
      if (auto moved = moved_part(*before, stick)) return moved;
  return std::nullopt;
}

std::string describe(const PedalSource& source) {
  const std::string of = source.joystick.empty() ? "" : " of " + source.joystick;
  switch (source.kind) {
    case PedalKind::kNone:
      return "none";
    case PedalKind::kKey:
      // GLFW names printable keys by their character.
      return source.index > 32 && source.index < 127
                 ? "key " + std::string(1, static_cast<char>(source.index))
                 : "key " + std::to_string(source.index);
    case PedalKind::kAxis:
      return "axis " + std::to_string(source.index + 1) + of;
    case PedalKind::kButton:
      return "button " + std::to_string(source.index + 1) + of;
  }
  return {};
}

void Pedals::update(const PedalReadings& readings) {
  for (const auto& [name, source] : map_) {
    State& state = states_[name];
    state.value = pedal_value(source, readings);
    state.held = state.value > (state.held ? kRelease : kPress);
  }
}

bool Pedals::has(const std::string& name) const {
  const auto it = map_.find(name);
  return it != map_.end() && it->second.kind != PedalKind::kNone;
}

double Pedals::value(const std::string& name) const {
  const auto it = states_.find(name);
  return has(name) && it != states_.end() ? it->second.value : 0;
}

bool Pedals::held(const std::string& name) const {
  const auto it = states_.find(name);
  return has(name) && it != states_.end() && it->second.held;
}

}  // namespace osteon
