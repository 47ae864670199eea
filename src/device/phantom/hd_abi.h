#pragma once

#include <cstdint>

/// The part of OpenHaptics' binary interface (HDAPI 3.x) that Osteon uses, written from its
/// documented calls: no SDK is needed to build. Units of the interface: mm, mm/s, N, N mm, rad;
/// frame x right, y up, z to the user; matrices by columns.
namespace osteon::hd {

using Handle = std::uint32_t;
using Enum = std::uint32_t;
using ErrorCode = std::uint32_t;
using Boolean = unsigned char;
/// Eight bytes on Linux, four on Windows, as `unsigned long` is there.
using ULong = unsigned long;
using Callback = unsigned (*)(void* user);

/// Given back by value.
struct ErrorInfo {
  ErrorCode code;
  int internal_code;
  Handle handle;
};
static_assert(sizeof(ErrorInfo) == 12);

inline constexpr Handle kInvalidHandle = 0xFFFFFFFF;
inline constexpr unsigned kCallbackDone = 0;
inline constexpr unsigned kCallbackContinue = 1;
inline constexpr std::uint16_t kDefaultPriority = 0xFFFF / 2;

// State.
inline constexpr Enum kButtons = 0x2000;
inline constexpr Enum kSafetySwitch = 0x2001;
inline constexpr Enum kInkwellSwitch = 0x2002;
inline constexpr Enum kVelocity = 0x2051;
inline constexpr Enum kTransform = 0x2052;
inline constexpr Enum kAngularVelocity = 0x2053;
inline constexpr Enum kModel = 0x2501;
inline constexpr Enum kUsableWorkspace = 0x2551;
inline constexpr Enum kOutputDof = 0x2554;
inline constexpr Enum kCalibrationStyle = 0x2555;
inline constexpr Enum kUpdateRate = 0x2600;
inline constexpr Enum kMaxStiffness = 0x2602;
inline constexpr Enum kMaxForce = 0x2603;
inline constexpr Enum kMaxContinuousForce = 0x2604;
inline constexpr Enum kMotorTemperature = 0x2605;
inline constexpr Enum kMaxTorque = 0x2622;
inline constexpr Enum kMaxContinuousTorque = 0x2623;
inline constexpr Enum kForce = 0x2700;
/// Of arms with six driven axes: Cartesian, about the gimbal's centre.
inline constexpr Enum kTorque = 0x2701;

// Capabilities.
inline constexpr Enum kForceOutput = 0x4000;
inline constexpr Enum kMaxForceClamping = 0x4001;
inline constexpr Enum kForceRamping = 0x4002;
inline constexpr Enum kSoftwareForceLimit = 0x4003;

// Calibration.
inline constexpr Enum kCalibrationOk = 0x5000;
inline constexpr Enum kCalibrationNeedsUpdate = 0x5001;
inline constexpr Enum kCalibrationNeedsManualInput = 0x5002;
inline constexpr Enum kStyleEncoderReset = 1;
inline constexpr Enum kStyleAuto = 2;
inline constexpr Enum kStyleInkwell = 4;

// Errors.
inline constexpr ErrorCode kSuccess = 0;
inline constexpr ErrorCode kInvalidEnum = 0x100;
inline constexpr ErrorCode kInvalidValue = 0x101;
inline constexpr ErrorCode kInvalidOperation = 0x102;
inline constexpr ErrorCode kInvalidInputType = 0x103;
inline constexpr ErrorCode kBadHandle = 0x104;
inline constexpr ErrorCode kWarmMotors = 0x200;
inline constexpr ErrorCode kExceededMaxForce = 0x201;
inline constexpr ErrorCode kExceededMaxForceImpulse = 0x202;
inline constexpr ErrorCode kExceededMaxVelocity = 0x203;
inline constexpr ErrorCode kForceError = 0x204;
inline constexpr ErrorCode kDeviceFault = 0x300;
inline constexpr ErrorCode kDeviceAlreadyInitiated = 0x301;
inline constexpr ErrorCode kCommError = 0x302;
inline constexpr ErrorCode kCommConfigError = 0x303;
inline constexpr ErrorCode kTimerError = 0x304;
inline constexpr ErrorCode kIllegalBegin = 0x400;
inline constexpr ErrorCode kIllegalEnd = 0x401;
inline constexpr ErrorCode kFrameError = 0x402;
inline constexpr ErrorCode kInvalidPriority = 0x500;
inline constexpr ErrorCode kSchedulerFull = 0x501;
inline constexpr ErrorCode kInvalidLicense = 0x600;

}  // namespace osteon::hd
