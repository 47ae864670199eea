#pragma once

#include <string_view>

#include "hd_session.h"
#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// What Osteon knows of a family of arms.
struct ArmModel {
  const char* profile;  ///< file in assets/devices with its limits
  bool has_dead_man;    ///< the stylus feels the hand
};

/// Family of an arm by the name that the library gives it ("PHANToM Premium 1.5"); the weakest one
/// for a name that is not known. `output_dof`: driven axes that the arm reports; 6: its stylus'
/// rotations too.
ArmModel arm_model(std::string_view model_name, int output_dof = 3);

/// Limits of an arm: the profile's, or what the arm itself reports where that is lower. Rotations
/// are driven only where it reports six driven axes.
DeviceInfo limited_by(const DeviceInfo& profile, const ArmReport& report);

}  // namespace osteon
