#pragma once

#include <array>
#include <atomic>
#include <memory>

#include "osteon/base/latest_value.h"
#include "osteon/device/haptic_device.h"
#include "osteon/scene/state.h"

namespace osteon {

/// One device for several hands of a session: it moves one of them, the others rest as if an
/// assistant held them. The window says whose the device shall be; the hand that has it gives it up
/// in its own tick, at zero force, and only then the other one takes it. A hand goes on where it
/// rested, wherever the device is, and its force rises over half a second.
class HandShare {
 public:
  explicit HandShare(std::unique_ptr<HapticDevice> device, std::size_t first);
  /// From the window's thread.
  void give(std::size_t hand) { wanted_.store(hand, std::memory_order_release); }
  std::size_t wanted() const { return wanted_.load(std::memory_order_acquire); }
  /// Where a hand shall rest, in V; from the window's thread. Not finite: ignored.
  void set_rest(std::size_t hand, const Pose& X_VD);
  /// For one thread that leads an emulated user's device: whether that hand has taken it, and where
  /// the device is to be so that the hand is there. Of a hand that has it.
  bool is_led(std::size_t hand) const { return led_.load(std::memory_order_acquire) == hand; }
  Pose to_device(std::size_t hand, const Pose& X_VD_hand);
  /// After every hand has ended its run: the device, still open.
  std::unique_ptr<HapticDevice> take_device() { return std::move(device_); }

 private:
  friend class SharedHand;
  std::unique_ptr<HapticDevice> device_;
  std::atomic<std::size_t> wanted_;
  std::atomic<std::size_t> owner_;  ///< only this hand's thread touches the device
  std::array<LatestValue<Pose>, kMaxHands> rests_;
  std::atomic<std::size_t> led_;  ///< the hand whose way from the device is told; kMaxHands: none
  std::array<LatestValue<Pose>, kMaxHands> shifts_;
};

/// What one hand sees of it: a device of its own. Allocates, locks and logs nothing in its ticks.
class SharedHand : public HapticDevice {
 public:
  /// `X_VD_rest`: where the hand rests until the device is given to it.
  SharedHand(std::shared_ptr<HandShare> share, std::size_t hand, const Pose& X_VD_rest);

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void write_torque(const Vec3& torque_V) override;
  void close() override;
  DeviceHealth health() const override;
  void calibrate() override;

 private:
  bool has_device() const;
  DeviceSample resting();
  DeviceSample moved(DeviceSample sample);

  std::shared_ptr<HandShare> share_;
  std::size_t hand_;
  DeviceInfo info_;
  Pose X_VD_;                                   ///< of the last reading
  Pose target_VD_;                              ///< where it shall rest
  Pose shift_{Vec3::Zero(), Quat::Identity()};  ///< from the device's pose to the hand's
  bool held_ = false;                           ///< the last reading was the device's
  double gain_ = 0;                             ///< of the force, rising after the device has come
  std::int64_t time_ns_ = 0;         ///< of the last reading, on a clock of the hand's own
  std::int64_t clock_shift_ns_ = 0;  ///< from the device's clock to that
};

}  // namespace osteon
