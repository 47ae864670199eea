#pragma once

#include "hd_abi.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// What an error of OpenHaptics means for the force; kNone for errors of a single query, which say
/// nothing about the device.
ForceOff force_off_for(hd::ErrorCode code);

/// In words, with what to do: "The arm does not answer: check its cable and its power". For codes
/// that Osteon does not know: that it is unknown.
const char* describe_hd_error(hd::ErrorCode code);

}  // namespace osteon
