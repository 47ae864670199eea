#pragma once

#include <memory>

#include "falcon_packet.h"
#include "osteon/device/haptic_device.h"
#include "usb/usb_transport.h"
#include "velocity_estimator.h"

namespace osteon {

/// The Novint Falcon over USB: three driven axes, a grip with four buttons (bits 0-3: plus,
/// forward, centre, minus) and no rotation. V has its origin in the middle of the workspace.
///
/// It must be homed once after it was switched on: the user moves the grip in and out until all
/// three encoders have seen their mark, then pulls it out; light red, blue, green. Each command to
/// the firmware is answered by a reading, so one that gets no answer for 10 ms is a silent device:
/// zero force, then a fault. Such a fault stays until it is over and zero has been ordered. The
/// firmware is not known to let go by itself when a program stops: closing sends zero.
class FalconDevice : public HapticDevice {
 public:
  /// Takes a link on which `bring_up_falcon` has succeeded.
  FalconDevice(std::unique_ptr<UsbLink> link, DeviceInfo info);
  ~FalconDevice() override;

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void close() override;
  DeviceHealth health() const override;
  void calibrate() override;

 private:
  void take(const UsbPacket& packet);
  void accept(const FalconReport& report, std::int64_t time_ns);
  void follow_homing(const FalconReport& report);
  void listen(std::int64_t now);
  void watch(std::int64_t now);
  void watch_link(std::int64_t now);
  void raise(ForceOff cause, const char* words, std::int64_t now);
  void settle(std::int64_t now);
  Vec3 allowed(const Vec3& force_V) const;
  bool yields_its_turn(const Vec3& force_V);
  void keep_talking(std::int64_t now);
  void send(const Vec3& force_V);

  std::unique_ptr<UsbLink> link_;
  DeviceInfo info_;
  FalconPacketReader reader_;
  VelocityEstimator velocity_;
  std::int64_t velocity_time_ns_ = 0;
  DeviceSample sample_;
  DeviceHealth health_;
  const char* fault_words_ = "";

  Vec3 p_F_;                         ///< last good position
  Vec3 ordered_V_ = Vec3::Zero();    ///< last force asked for
  bool homing_ = true;               ///< the firmware is asked to home
  bool pulled_out_ = false;          ///< seen far out since it was homed
  std::int64_t unanswered_ns_ = -1;  ///< time of the first command without an answer; -1: none
  std::int64_t last_write_ns_ = -1;  ///< -1: none yet
  std::int64_t last_good_ns_ = 0;
  std::int64_t last_listened_ns_ = 0;
  std::int64_t fault_seen_ns_ = 0;
  std::int64_t restarted_ns_;
  std::int64_t last_sent_ns_ = 0;
  int busy_writes_ = 0;  ///< in a row that found another on its way
};

}  // namespace osteon
