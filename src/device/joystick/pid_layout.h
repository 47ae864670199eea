#pragma once

#include <array>
#include <vector>

#include "hid_descriptor.h"
#include "joystick_profile.h"

namespace osteon {

// Usages of the Physical Input Device page (HID Usage Tables, page 0x0F) that Osteon speaks.
namespace pid {
constexpr std::uint32_t usage(std::uint16_t id) { return hid_usage(0x0F, id); }
inline constexpr std::uint32_t kSetEffect = usage(0x21), kBlockIndex = usage(0x22),
                               kConstantForce = usage(0x26), kDuration = usage(0x50),
                               kGain = usage(0x52), kTriggerButton = usage(0x53),
                               kAxesEnable = usage(0x55), kMagnitude = usage(0x70),
                               kSetConstantForce = usage(0x73), kOperation = usage(0x77),
                               kStart = usage(0x79), kStop = usage(0x7B), kLoopCount = usage(0x7C),
                               kDeviceGain = usage(0x7D), kDeviceGainValue = usage(0x7E),
                               kPool = usage(0x7F), kSimultaneousMax = usage(0x83),
                               kBlockLoad = usage(0x89), kLoadSuccess = usage(0x8C),
                               kLoadFull = usage(0x8D), kBlockFree = usage(0x90),
                               kState = usage(0x92), kControlReport = usage(0x95),
                               kControl = usage(0x96), kEnableActuators = usage(0x97),
                               kDisableActuators = usage(0x98), kStopAll = usage(0x99),
                               kReset = usage(0x9A), kPaused = usage(0x9F),
                               kActuatorsEnabled = usage(0xA0), kSafetySwitch = usage(0xA4),
                               kActuatorPower = usage(0xA6), kDeviceManaged = usage(0xA9),
                               kCreateEffect = usage(0xAB);
}  // namespace pid

/// A report under construction or as received; its own memory.
struct PidReport {
  HidReport kind = HidReport::kOutput;
  std::uint8_t id = 0;
  std::size_t size = 0;
  std::array<std::uint8_t, 512> bytes{};
  std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// Where a joystick of HID PID class 1.0 keeps what Osteon needs: found by usages in its own report
/// descriptor.
class PidLayout {
 public:
  /// Fails with the name of what the device lacks.
  static Result<PidLayout> find(HidReports reports, const JoystickProfile& profile);

  /// An empty report of the collection, its ID in place.
  PidReport make(HidReport kind, std::uint32_t collection) const;
  /// Sets a value; nothing when the device's report has no such field.
  void set(PidReport& report, std::uint32_t collection, std::uint32_t usage,
           std::int64_t value) const;
  /// Sets the largest value of the field's range.
  void set_largest(PidReport& report, std::uint32_t collection, std::uint32_t usage) const;
  /// Sets every bit: outside most ranges, which HID calls "no value" and PID "infinite".
  void set_ones(PidReport& report, std::uint32_t collection, std::uint32_t usage) const;
  /// Names a usage: in an array field, or by its own bit.
  void choose(PidReport& report, std::uint32_t collection, std::uint32_t usage) const;
  /// Value of a field; `fallback` when the report has none.
  std::int64_t get(std::span<const std::uint8_t> bytes, HidReport kind, std::uint32_t collection,
                   std::uint32_t usage, std::int64_t fallback) const;
  /// The report names that usage.
  bool names(std::span<const std::uint8_t> bytes, HidReport kind, std::uint32_t collection,
             std::uint32_t usage) const;

  const std::array<HidField, 3>& axes() const { return axes_; }
  const HidField& rotation() const { return rotation_; }
  const std::vector<HidField>& buttons() const { return buttons_; }
  const HidField& magnitude() const { return magnitude_; }
  std::uint32_t control_collection() const { return control_collection_; }
  bool has_state() const { return state_id_ >= 0; }
  bool is_state(std::span<const std::uint8_t> bytes) const;
  bool is_reading(std::span<const std::uint8_t> bytes) const;

 private:
  Result<void> find_inputs(const JoystickProfile& profile);
  Result<void> find_effects();
  Result<HidField> demand_field(HidReport kind, std::uint32_t collection, std::uint32_t usage,
                                const char* name) const;
  bool is_report(std::span<const std::uint8_t> bytes, std::uint8_t id) const;

  HidReports reports_;
  std::array<HidField, 3> axes_{};
  HidField rotation_;
  std::vector<HidField> buttons_;
  HidField magnitude_;
  std::uint32_t control_collection_ = 0;
  int state_id_ = -1;
};

}  // namespace osteon
