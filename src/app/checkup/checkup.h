#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "checkup/computer_findings.h"
#include "checkup/device_findings.h"

namespace osteon {

/// What a check-up looks at besides the drivers' lists and the computer.
struct CheckupOrder {
  Finding graphics;  ///< of the context that draws
  /// The device to try: open and lent for so long; or the driver that opens one of its own; or
  /// neither.
  std::unique_ptr<HapticDevice> device;
  const Driver* driver = nullptr;
  DeviceInfo info;    ///< of that device
  bool push = false;  ///< the gentle force test: the user has consented
  double read_s = 1;  ///< how long the device is read
  double loop_s = 2;  ///< how long the 1 kHz loop is measured
};

struct CheckupReport {
  Findings findings;
  std::string verdict;  ///< a plain sentence
  UdevRule udev;
  bool ended_early = false;
};

/// Tells what it does now, "Reading the device", and how far it is, 0 to 1.
using CheckupProgress = std::function<void(const char* what, double fraction)>;

/// The whole check-up, some seconds long. `cancelled` is asked all along: true ends it, with the
/// device at zero force. The device of the order stays open in it.
CheckupReport run_checkup(CheckupOrder& order, std::span<const Driver> table,
                          const CheckupProgress& progress, const std::function<bool()>& cancelled);

}  // namespace osteon
