#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "osteon/device/haptic_device.h"

namespace osteon {

/// A device that also keeps what the last seconds brought and sent, for a look afterwards.
/// Allocates in its constructor only.
class DeviceLog : public HapticDevice {
 public:
  /// `file`, where given, is begun now and written when the device is closed, by whom ever: the
  /// program may be ending badly.
  explicit DeviceLog(std::unique_ptr<HapticDevice> device, double seconds = 20,
                     std::filesystem::path file = {});
  const DeviceInfo& info() const override { return device_->info(); }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void write_torque(const Vec3& torque_V) override;
  void close() override;
  DeviceHealth health() const override { return device_->health(); }
  void calibrate() override { device_->calibrate(); }

  /// CSV: time_s, position (mm) and force (N) of each write, and torque (N m) where a rotation is
  /// driven, then the line "closed".
  Result<void> save(const std::filesystem::path& file) const;

 private:
  struct Row {
    std::int64_t time_ns = 0;
    Vec3 p_V = Vec3::Zero();
    DeviceWrench wrench;
  };
  static std::string line_of(const Row& row, bool with_torque);

  std::unique_ptr<HapticDevice> device_;
  std::filesystem::path file_;
  std::vector<Row> rows_;
  std::size_t count_ = 0;
  Row now_;
  bool closed_ = false;
};

}  // namespace osteon
