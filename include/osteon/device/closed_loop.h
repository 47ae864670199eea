#pragma once

#include "osteon/device/haptic_device.h"
#include "osteon/device/safety.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {

/// An emulated hand that is led onto a wall through the safety gate.
struct WallTrial {
  HandParams hand;
  double wall_n_per_m = 2000;
  double delay_s = 0;         ///< from the reading to the force at the hand, beside the tick itself
  bool delay_before = false;  ///< the reading is late; else the force is
  double approach_m_per_s = 0.1;
  double press_n = 3;    ///< the hand aims where wall and grip balance at this force
  double seconds = 8;    ///< after the aim is reached, in whole half seconds; fewer once at rest
  bool filtered = true;  ///< false: the force goes to the hand without the passivity stage
};

/// How a trial ended: its last half second. One that has been at rest for a second (0.1 um from end
/// to end) ends there: nothing in the loop can stir it again.
struct WallOutcome {
  double swing_m = 0;          ///< from end to end
  double earlier_swing_m = 0;  ///< of the half second before
  double force_n = 0;          ///< mean at the hand
  double depth_m = 0;          ///< mean, past the wall's face
  PassivityState passivity;
  ForceOff cause = ForceOff::kNone;
  /// Neither growing nor more than `limit_m` from end to end.
  bool settled(double limit_m = 0.0002) const {
    return cause == ForceOff::kNone && swing_m < limit_m;
  }
};

/// Runs a trial at the device's rate; the hand moves in steps of a tenth of a tick under a force
/// that is held between ticks, as a motor holds it. The wall fills x < 0, in V.
WallOutcome press_wall(const WallTrial& trial, const DeviceInfo& info,
                       const SafetyParams& params = {});

}  // namespace osteon
