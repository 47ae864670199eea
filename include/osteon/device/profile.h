#pragma once

#include <filesystem>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// Reads a device profile (TOML, see assets/devices). Strict: a key that is missing, unknown, of
/// another type or out of range fails with its name and line.
Result<DeviceInfo> load_device_profile(const std::filesystem::path& path);

}  // namespace osteon
