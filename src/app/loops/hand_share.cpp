#include "loops/hand_share.h"

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

constexpr double kRise_s = 0.5;     // of the force, as after a fault
constexpr double kNudge_s = 0.030;  // in which a resting hand follows where it shall rest

double period_of(const DeviceInfo& info) { return info.rate_hz > 0 ? 1 / info.rate_hz : 0.001; }

}  // namespace

HandShare::HandShare(std::unique_ptr<HapticDevice> device, std::size_t first)
    : device_(std::move(device)), wanted_(first), owner_(first), led_(first) {
  if (first < kMaxHands) shifts_[first].publish(Pose{Vec3::Zero(), Quat::Identity()});
}

Pose HandShare::to_device(std::size_t hand, const Pose& X_VD_hand) {
  const Pose& shift = shifts_[hand].read();
  return {X_VD_hand.p - shift.p, (X_VD_hand.q * shift.q.conjugate()).normalized()};
}

void HandShare::set_rest(std::size_t hand, const Pose& X_VD) {
  if (hand < kMaxHands && is_finite(X_VD)) rests_[hand].publish(X_VD);
}

SharedHand::SharedHand(std::shared_ptr<HandShare> share, std::size_t hand, const Pose& X_VD_rest)
    : share_(std::move(share)),
      hand_(hand),
      info_(share_->device_->info()),
      X_VD_(X_VD_rest),
      target_VD_(X_VD_rest),
      held_(share_->owner_.load() == hand),
      gain_(held_ ? 1 : 0) {}

bool SharedHand::has_device() const {
  return share_->owner_.load(std::memory_order_acquire) == hand_;
}

// Invariant: the device is touched by the owner's thread alone, and only the owner names another.
DeviceSample SharedHand::read() {
  if (!has_device()) return resting();
  const std::size_t wanted = share_->wanted();
  if (wanted == hand_) return moved(share_->device_->read());
  share_->device_->write_force(Vec3::Zero());
  held_ = false;
  target_VD_ = X_VD_;
  share_->led_.store(kMaxHands, std::memory_order_release);
  share_->owner_.store(wanted, std::memory_order_release);
  return resting();
}

DeviceSample SharedHand::resting() {
  bool fresh = false;
  const Pose& wish = share_->rests_[hand_].read(&fresh);
  if (fresh) target_VD_ = wish;
  const double dt_s = period_of(info_);
  const double share = std::min(1.0, dt_s / kNudge_s);
  const Vec3 step = share * (target_VD_.p - X_VD_.p);
  X_VD_.p += step;
  X_VD_.q = X_VD_.q.slerp(share, target_VD_.q).normalized();
  DeviceSample sample;
  sample.time_ns = time_ns_ += static_cast<std::int64_t>(dt_s * 1e9);
  sample.X_VD = X_VD_;
  sample.v_V = step / dt_s;
  return sample;
}

DeviceSample SharedHand::moved(DeviceSample sample) {
  if (!is_finite(sample.X_VD)) return sample;
  if (!held_) {
    held_ = true;
    gain_ = 0;
    // The gate takes a hand whose readings grow no younger for one that was lost.
    clock_shift_ns_ = time_ns_ + 1 - sample.time_ns;
    shift_.p = X_VD_.p - sample.X_VD.p;
    shift_.q = sample.X_VD.q.conjugate() * X_VD_.q;
    share_->shifts_[hand_].publish(shift_);
    share_->led_.store(hand_, std::memory_order_release);
  }
  gain_ = std::min(1.0, gain_ + period_of(info_) / kRise_s);
  sample.X_VD.p += shift_.p;
  sample.X_VD.q = (sample.X_VD.q * shift_.q).normalized();
  X_VD_ = target_VD_ = sample.X_VD;
  time_ns_ = sample.time_ns += clock_shift_ns_;
  return sample;
}

void SharedHand::write_force(const Vec3& force_V) {
  if (has_device()) share_->device_->write_force(gain_ * force_V);
}

void SharedHand::write_torque(const Vec3& torque_V) {
  if (has_device()) share_->device_->write_torque(gain_ * torque_V);
}

void SharedHand::close() {
  if (has_device() && share_->device_) share_->device_->close();
}

DeviceHealth SharedHand::health() const {
  return has_device() ? share_->device_->health() : DeviceHealth{};
}

void SharedHand::calibrate() {
  if (has_device()) share_->device_->calibrate();
}

}  // namespace osteon
