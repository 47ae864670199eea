#pragma once

#include <atomic>
#include <cstdint>

#include "hd_api.h"
#include "osteon/base/latest_value.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// What the servo loop must know of one arm.
struct ArmSetup {
  hd::Handle handle = hd::kInvalidHandle;
  Vec3 centre_m = Vec3::Zero();  ///< of the workspace, in the library's frame; V's origin
  double peak_force_n = 0;
  double peak_torque_nm = 0;  ///< 0: no rotation is driven
  bool has_dead_man = false;
  hd::Enum calibration_styles = 0;  ///< bits
};

struct ServoReading {
  DeviceSample sample;
  DeviceHealth health;
};

/// One arm in OpenHaptics' servo loop: exchanges reading and force with the haptic thread without a
/// lock, and puts out zero by itself when the arm reports a fault, is not calibrated, gives
/// readings that make no sense for 10 ms, or when no force has been ordered for 20 ms. Such a fault
/// stays until it has been gone for 50 ms and zero is ordered, so that force never jumps back in.
class ServoArm {
 public:
  using Clock = std::int64_t (*)();
  ServoArm(const HdApi& api, const ArmSetup& setup, Clock now_ns);

  // For the thread that uses the device; none of these waits or allocates.
  const ServoReading& newest() { return to_user_.read(); }
  void order(const DeviceWrench& wrench);
  void wish_calibration() { calibration_wished_ = true; }
  /// Zero from the next pass on, whatever is ordered; `at_rest` once that has gone out.
  void end() { ended_ = true; }
  bool at_rest() const { return at_rest_; }
  hd::Handle handle() const { return setup_.handle; }

  /// For the servo loop, once a pass.
  void tick();

 private:
  struct ForceOrder {
    DeviceWrench wrench;
    std::int64_t time_ns = 0;
    std::uint64_t number = 0;  ///< 0: none yet

    bool is_zero() const { return wrench.force_V.isZero(0) && wrench.torque_V.isZero(0); }
  };
  struct Raw;

  Raw read_raw() const;
  bool accept(const Raw& raw, std::int64_t now);
  void take_errors(std::int64_t now);
  void watch_readings(bool good, std::int64_t now);
  void watch_heat(std::int64_t now);
  void watch_calibration();
  void tell_calibration(hd::Enum status);
  void watch_orders(const ForceOrder& order, std::int64_t now);
  void raise(ForceOff cause, const char* words, std::int64_t now);
  void settle(const ForceOrder& order, std::int64_t now);
  DeviceWrench wrench_for(const ForceOrder& order) const;
  void put_out(const DeviceWrench& wrench);

  const HdApi api_;
  const ArmSetup setup_;
  const Clock now_ns_;

  LatestValue<ServoReading> to_user_;
  LatestValue<ForceOrder> to_servo_;
  std::uint64_t orders_ = 0;  ///< of the user's thread
  std::atomic<bool> calibration_wished_{false};
  std::atomic<bool> ended_{false};
  std::atomic<bool> at_rest_{false};

  // Of the servo loop.
  ServoReading state_;
  const char* fault_words_ = "";
  const char* calibration_words_ = "";
  std::int64_t fault_seen_ns_ = 0;
  std::int64_t last_good_ns_ = 0;
  int bad_in_a_row_ = 0;
  std::uint64_t last_order_ = 0;
  std::uint64_t passes_ = 0;
};

}  // namespace osteon
