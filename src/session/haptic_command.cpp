#include "haptic_command.h"

namespace osteon {
namespace {

constexpr double kStiffestGrab = 1000;  // N/m

// False for a NaN too.
bool within(double value, double min, double max) { return value >= min && value <= max; }

}  // namespace

void apply_command(const Command& command, HapticParams& params) {
  switch (command.kind) {
    case CommandKind::kSetStiffness:
      if (within(command.value, 1, 1e5)) params.stiffness_n_per_m = command.value;
      break;
    case CommandKind::kSetFrictionScale:
      if (within(command.value, 0, 10)) params.friction_scale = command.value;
      break;
    case CommandKind::kForceOff:
      if (within(command.value, 0, 1)) params.force_on = command.value < 0.5;
      break;
    case CommandKind::kGrab:
      if (within(command.value, 0, kStiffestGrab)) params.grab_n_per_m = command.value;
      break;
    default:
      break;
  }
}

}  // namespace osteon
