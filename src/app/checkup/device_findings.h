#pragma once

#include <functional>
#include <span>

#include "checkup/finding.h"
#include "osteon/device/drivers.h"

namespace osteon {

/// What every driver lists and what it cannot use, with its reasons. Never fails: a driver without
/// library, permission or USB is a note. For the window too.
Findings device_findings(std::span<const Driver> table);

/// True when a driver of a real device with motors lists one.
bool has_force_device(std::span<const Driver> table);

/// How a device is tried out.
struct DeviceTrial {
  double read_s = 1;    ///< how long it is read
  bool push = false;    ///< the gentle force test; only with the user's consent
  double push_n = 0.5;  ///< at most half of what the device bears
  double push_s = 0.5;  ///< up, and again down
  /// Asked at each tick: true ends the trial at once, with the force at zero. May be empty.
  std::function<bool()> cancelled;
};

/// Opens the device and tells of calibration, reading rate and jitter, health and, when asked for,
/// of the answer to a small force that rises and falls on each of its axes. The safety gate stands
/// between. Leaves the device at zero force and closed.
Findings try_device(const Driver& driver, const DeviceInfo& info, const DeviceTrial& trial);
/// The same with a device that is open already; it stays open.
Findings try_device(HapticDevice& device, const DeviceTrial& trial);

}  // namespace osteon
