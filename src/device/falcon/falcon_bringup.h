#pragma once

#include <filesystem>
#include <string>

#include "osteon/base/result.h"
#include "usb/usb_transport.h"

namespace osteon {

inline constexpr std::uint16_t kFalconVendor = 0x0403;
inline constexpr std::uint16_t kFalconProduct = 0xcb48;

/// How the Falcon's serial converter is used: bulk, full speed.
UsbChannel falcon_channel();

/// Where the user's copy of the firmware is looked for: $OSTEON_FALCON_FIRMWARE, else
/// falcon_firmware.bin in the folder of Osteon's settings.
std::filesystem::path falcon_firmware_file();

/// Content of that file. The error says where it belongs and where it comes from.
Result<std::string> load_falcon_firmware();

/// Sets the converter up and makes the Falcon's firmware run: looks whether it does already (it
/// stays while the power is on), else loads `firmware` into the boot loader and checks the echo of
/// every byte. Waits, each time with a limit: some seconds in all. Motors stay at zero.
Result<void> bring_up_falcon(UsbLink& link, const std::string& firmware);

}  // namespace osteon
