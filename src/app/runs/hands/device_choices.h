#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"
#include "osteon/scene/path.h"

namespace osteon {

/// One line of the device menu.
struct DeviceChoice {
  std::string label;  ///< "Mouse and keyboard"
  std::string driver;
  DeviceInfo info;
};

/// Every device that can be opened now. A driver that cannot list its devices is left out and its
/// reason is added to `problems`.
std::vector<DeviceChoice> list_device_choices(std::vector<std::string>* problems);

/// What tells this choice from the others: "mouse", or "phantom:Left Device" where the device has a
/// serial number.
std::string key_of(const DeviceChoice& choice);

/// Index of the choice of that key, else of the first of that driver; 0 when there is none.
int find_choice(const std::vector<DeviceChoice>& choices, const std::string& key);

/// Its user is an emulated one who plays a path, in World.
bool plays_demo(const DeviceChoice& choice);

/// Opens a device. A virtual one plays `demo`, over and over.
Result<std::unique_ptr<HapticDevice>> open_choice(const DeviceChoice& choice,
                                                  const ProbePath& demo);

}  // namespace osteon
