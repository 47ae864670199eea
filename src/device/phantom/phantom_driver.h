#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

// The "phantom" line of the table of drivers.

/// Arms that the maker's set-up program has named, or "Default Device" when it has named none; none
/// without the library. An arm's limits are known once it is open: until then they are the weakest.
Result<std::vector<DeviceInfo>> list_phantom();
/// By `DeviceInfo::serial`, the name of the set-up program. Two at once are one for each hand.
Result<std::unique_ptr<HapticDevice>> open_phantom(const DeviceInfo& info);
/// Says when the library is missing or cannot be used.
std::vector<std::string> unusable_phantom();

}  // namespace osteon
