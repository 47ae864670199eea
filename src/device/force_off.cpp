#include "osteon/device/haptic_device.h"

namespace osteon {

const char* describe(ForceOff cause) {
  switch (cause) {
    case ForceOff::kNone:
      return "Force is on";
    case ForceOff::kButton:
      return "Force is off: the device's button was released";
    case ForceOff::kVelocity:
      return "Force is off: the device moved too fast";
    case ForceOff::kWatchdog:
      return "Force is off: the simulation stopped answering";
    case ForceOff::kSoftware:
      return "Force is off: switch it on when you hold the device";
    case ForceOff::kDisconnect:
      return "Force is off: the device stopped answering or was unplugged";
    case ForceOff::kDeadMan:
      return "Force is off: no hand is on the device";
    case ForceOff::kNotFinite:
      return "Force is off: a value was not a finite number";
    case ForceOff::kTemperature:
      return "Force is off: the motors are too hot";
    case ForceOff::kCalibration:
      return "Force is off: the device is not calibrated";
    case ForceOff::kDeviceFault:
      return "Force is off: the device reports a fault";
  }
  return "Force is off";
}

}  // namespace osteon
