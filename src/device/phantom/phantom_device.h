#pragma once

#include <memory>
#include <string>

#include "hd_session.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// An arm of the PHANToM class (Touch, Touch X, Desktop, Premium) through OpenHaptics. V has the
/// axes of the library's frame and its origin in the middle of the arm's usable workspace. The
/// library's own thread runs the servo loop; `read` and `write_force` exchange with it lock-free.
class PhantomDevice : public HapticDevice {
 public:
  /// Opens the arm of that name ("Left Device"; empty: the default one), which stays its `serial`:
  /// what the user calls it outlives the hardware.
  static Result<std::unique_ptr<HapticDevice>> open(std::shared_ptr<HdSession> session,
                                                    const std::string& config_name);
  ~PhantomDevice() override;

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void write_torque(const Vec3& torque_V) override { torque_V_ = torque_V; }
  void close() override;
  DeviceHealth health() const override;
  void calibrate() override;

 private:
  PhantomDevice(std::shared_ptr<HdSession> session, ServoArm& arm, DeviceInfo info);

  std::shared_ptr<HdSession> session_;
  ServoArm* arm_;  ///< of session_; null once closed
  DeviceInfo info_;
  ServoReading last_;
  Vec3 torque_V_ = Vec3::Zero();  ///< for the next force
};

/// `DeviceInfo::name` of every arm; they differ by `serial`.
inline constexpr const char* kArmName = "PHANToM arm";

}  // namespace osteon
