#pragma once

#include "loops/device_mapping.h"
#include "loops/mapping_settings.h"
#include "osteon/device/haptic_device.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Turns of the device's axes for patient-aligned use: V x, y, z are World x, z, -y.
Quat patient_axes();

/// The hand in World, from readings: scale, clutch, and axes that may be turned without the tool
/// jumping. While the clutch is held the tool's place stands still and its rotation follows.
class HandMapping {
 public:
  HandMapping(const DeviceMapping& start, const MappingSettings& settings);
  /// Of a finite reading.
  ToolInput to_world(const DeviceSample& sample, bool clutch_pedal);
  /// Turns the device's axes about the tool; the place of the tool stays.
  void align(const Quat& q_WV);
  /// Force on the hand; none while the clutch is held: the tool's force is not the hand's then.
  Vec3 force_to_device(const Vec3& force_W) const;
  bool clutched() const { return clutched_; }
  /// The clutch was let go in the last reading: the force comes back from zero.
  bool released() const { return released_; }
  const DeviceMapping& now() const { return mapping_; }

 private:
  void put_tool_at(const Vec3& p_W);

  DeviceMapping mapping_;
  int clutch_button_;
  Vec3 p_V_ = Vec3::Zero();  ///< of the last reading
  Vec3 p_W_;                 ///< of the tool
  bool seen_ = false;        ///< a reading
  bool clutched_ = false;
  bool released_ = false;
};

}  // namespace osteon
