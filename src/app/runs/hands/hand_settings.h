#pragma once

#include <map>
#include <string>

#include "loops/mapping_settings.h"
#include "osteon/device/haptic_device.h"
#include "runs/hands/pedals.h"

namespace osteon {

/// How each device is used on each case: by `mapping_key`.
using MappingMap = std::map<std::string, MappingSettings>;

/// "phantom A1B2 | wrist": a device and a case.
std::string mapping_key(const DeviceInfo& info, const std::string& case_name);

/// The user's for this device and case; the defaults when there are none.
MappingSettings mapping_of(const MappingMap& mappings, const std::string& key);

}  // namespace osteon
