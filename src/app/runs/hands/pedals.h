#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace osteon {

enum class PedalKind { kNone, kKey, kAxis, kButton };

/// What drives a pedal or a knob: a key, or an axis or a button of any HID joystick.
struct PedalSource {
  PedalKind kind = PedalKind::kNone;
  std::string joystick;        ///< its name; empty: any
  int index = 0;               ///< GLFW key, or number of the axis or button
  double rest = -1, full = 1;  ///< of an axis: where the value is 0 and where it is 1

  bool operator==(const PedalSource&) const = default;
};

/// Pedals and knobs by what they do: "dead-man", "clutch", and names that procedures give.
using PedalMap = std::map<std::string, PedalSource>;

inline constexpr const char* kDeadManPedal = "dead-man";  ///< must be held for force
inline constexpr const char* kClutchPedal = "clutch";     ///< while held, the hand moves alone
inline constexpr const char* kPowerPedal = "power";       ///< drives what the hand holds

/// A HID joystick or a set of pedals as the system reads it.
struct ControllerReading {
  std::string name;
  std::vector<double> axes;  ///< -1 to 1
  std::vector<bool> buttons;
};

/// All that could be a pedal, at one moment.
struct PedalReadings {
  std::vector<int> keys;  ///< that are down
  std::vector<ControllerReading> joysticks;
};

/// From 0 (at rest) to 1. A joystick that is not there, an axis that it has not and a value that is
/// no number are 0: a pedal that is unplugged is let go.
double pedal_value(const PedalSource& source, const PedalReadings& readings);

/// What the user has just moved, to tie a pedal to it: the input that went farthest from `rest`.
std::optional<PedalSource> moved_input(const PedalReadings& rest, const PedalReadings& now);

/// In words: "Left Ctrl", "axis 2 of T-Pedals".
std::string describe(const PedalSource& source);

/// The pedals in use. A held pedal needs to come back a little before it counts as let go.
class Pedals {
 public:
  void set_map(PedalMap map) { map_ = std::move(map); }
  const PedalMap& map() const { return map_; }
  void update(const PedalReadings& readings);
  bool has(const std::string& name) const;
  double value(const std::string& name) const;
  bool held(const std::string& name) const;

 private:
  struct State {
    double value = 0;
    bool held = false;
  };
  PedalMap map_;
  std::map<std::string, State> states_;
};

}  // namespace osteon
