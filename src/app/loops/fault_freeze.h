#pragma once

#include "osteon/scene/state.h"

namespace osteon {

/// After a fault of the safety gate an instrument stays where it is until the user switches the
/// force on again; then it goes to where the device has it while the force rises. Plain values, fit
/// for the haptic tick; what it gives is what the session gets and a recording keeps.
class FaultFreeze {
 public:
  /// `return_s`: how long the way back takes; above 0.
  explicit FaultFreeze(double return_s) : return_s_(return_s) {}
  /// Where the session shall have the hand. `fault`: the gate is off for a fault.
  ToolInput input(const ToolInput& device, bool fault, double dt_s);

 private:
  double return_s_;
  ToolInput from_;    ///< where it froze
  ToolInput last_;    ///< given last
  double share_ = 1;  ///< of the way back; 1: it is where the device has it
  bool begun_ = false;
};

}  // namespace osteon
