#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// A USB device that a profile knows.
struct UsbId {
  std::uint16_t vendor = 0, product = 0;
  std::string name;  ///< of the profile

  bool operator==(const UsbId&) const = default;
};

/// The USB devices of every profile (*.toml) in `folder`, and those that drivers know by
/// themselves; by vendor and product, each once. A profile that cannot be read is left out: its
/// driver says so.
std::vector<UsbId> known_usb_devices(const std::filesystem::path& folder);

/// Content of a udev rules file that lets the user at the seat open these devices (Linux).
std::string udev_rules(const std::vector<UsbId>& devices);

}  // namespace osteon
