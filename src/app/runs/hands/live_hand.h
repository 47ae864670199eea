#pragma once

#include <memory>
#include <optional>
#include <string>

#include "loops/runtime.h"
#include "runs/hands/device_choices.h"
#include "runs/replays/path_orders.h"
#include "runs/reports/contact_timeline.h"
#include "runs/reports/force_history.h"

namespace osteon {

class MouseDevice;
class PadDevice;

/// A hand of a live run as the run is asked to have it.
struct LiveHandOrder {
  DeviceChoice choice;
  std::string name;              ///< "left"; empty: the only one
  std::uint32_t instrument = 0;  ///< in the tray
  MappingSettings user = {};
};

/// One hand of a live run: what it is moved by, where it is, what its loop told last.
struct LiveHand {
  DeviceChoice choice;
  std::string name;
  std::uint32_t instrument = 0;  ///< at the start of the run
  MappingSettings user;
  DeviceInfo opened;  ///< of the device of the run, which knows more than a list
  DeviceMapping mapping;
  Pose X_WD_wanted;
  std::unique_ptr<HapticDevice> held;  ///< between two runs
  std::string driver, serial;          ///< of the device held or in use
  bool same_device = false;            ///< as in the run before
  /// By a fault in the run before: the user re-arms, no other.
  ForceOff tripped = ForceOff::kNone;
  std::optional<PathOrders> orders;  ///< of the path that it plays
  GuideLine guide;                   ///< where it shall be led
  MouseDevice* mouse = nullptr;      ///< of the runtime, when it is one
  PadDevice* pad = nullptr;
  RenderSnapshot snapshot;
  DeviceStatus status;
  LoopStats haptic;
  ForceHistory force;
  ContactTimeline contacts;

  /// Before the first tick has been seen it is where the run began.
  Pose probe_now() const { return snapshot.tool.tick > 0 ? snapshot.tool.X_WP : X_WD_wanted; }
};

}  // namespace osteon
