#include "hd_errors.h"

namespace osteon {

ForceOff force_off_for(hd::ErrorCode code) {
  switch (code) {
    case hd::kSuccess:
    case hd::kInvalidEnum:
    case hd::kInvalidValue:
    case hd::kInvalidOperation:
    case hd::kInvalidInputType:
      return ForceOff::kNone;
    case hd::kWarmMotors:
      return ForceOff::kTemperature;
    case hd::kExceededMaxVelocity:
      return ForceOff::kVelocity;
    case hd::kBadHandle:
    case hd::kCommError:
    case hd::kCommConfigError:
      return ForceOff::kDisconnect;
    default:
      return ForceOff::kDeviceFault;
  }
}

const char* describe_hd_error(hd::ErrorCode code) {
  switch (code) {
    case hd::kSuccess:
      return "";
    case hd::kWarmMotors:
      return "The arm's motors are warm: let it rest for some minutes";
    case hd::kExceededMaxForce:
      return "The arm was asked for more force than it can give";
    case hd::kExceededMaxForceImpulse:
      return "The arm was asked for too sudden a force";
    case hd::kExceededMaxVelocity:
      return "The arm moved too fast";
    case hd::kForceError:
      return "The arm could not give its force: switch it off and on";
    case hd::kDeviceFault:
      return "The arm reports a fault: switch it off and on";
    case hd::kDeviceAlreadyInitiated:
      return "The arm is in use already: close the other program";
    case hd::kBadHandle:
    case hd::kCommError:
      return "The arm does not answer: check its cable and its power";
    case hd::kCommConfigError:
      return "The arm's connection is set up wrongly: run the maker's set-up program";
    case hd::kTimerError:
      return "OpenHaptics could not start its servo loop";
    case hd::kIllegalBegin:
    case hd::kIllegalEnd:
    case hd::kFrameError:
      return "OpenHaptics refused a frame: another program may be using the arm";
    case hd::kInvalidPriority:
    case hd::kSchedulerFull:
      return "OpenHaptics accepted no more work for its servo loop";
    case hd::kInvalidLicense:
      return "OpenHaptics has no valid licence: install the maker's licence";
    case hd::kInvalidEnum:
    case hd::kInvalidValue:
    case hd::kInvalidOperation:
    case hd::kInvalidInputType:
      return "OpenHaptics does not know a request";
    default:
      return "OpenHaptics reports an error that Osteon does not know";
  }
}

}  // namespace osteon
