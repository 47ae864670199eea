#include "commands/teaching/led_hand.h"

#include <chrono>
#include <thread>
#include <utility>

#include "loops/hand_mapping.h"

namespace osteon {
namespace {

constexpr double kRests_s = 0.1;  // without moving: a hand that lets go of its device
constexpr double kMoves_m = 1e-7, kTurns = 1e-7;

bool moves(const Pose& from, const Pose& to) {
  return (to.p - from.p).norm() > kMoves_m ||
         (to.q.coeffs() - from.q.coeffs()).cwiseAbs().maxCoeff() > kTurns;
}

}  // namespace

HandWill::HandWill(const HeadlessHand& hand, std::span<const std::string> tray)
    : player_(hand.player), path_(hand.path), commands_(hand.path, tray), X_(start()) {}

Pose HandWill::start() const { return player_ ? player_->start() : path_.at(0).X_WD; }

void HandWill::step(double dt_s) {
  if (player_) {
    X_ = player_->step(dt_s);
    said_ = player_->command();
    return;
  }
  const PathSample wanted = path_.at(time_s_);
  said_ = commands_.at(time_s_);
  X_ = wanted.X_WD;
  buttons_ = wanted.button ? 1u : 0u;
  time_s_ += dt_s;
}

void HandWill::feel(const Vec3& force_W) {
  if (player_) player_->feel(force_W);
}

bool HandWill::done() const { return player_ ? player_->done() : time_s_ > path_.duration_s(); }

Result<LedHands> LedHands::make(std::unique_ptr<HapticDevice> device, std::string label,
                                std::span<const Pose> starts_W) {
  LedHands led;
  led.user_ = dynamic_cast<EmulatedUser*>(device.get());
  if (!led.user_)
    return fail("this device is held by a real hand, which no virtual surgeon can lead", label,
                "Choose a virtual device, or play the exercise yourself with: osteon window "
                "--exercise");
  led.label_ = std::move(label);
  led.info_ = device->info();
  led.device_ = std::move(device);
  // The middle of the workspace is where the first hand begins.
  led.mapping_.X_WV = {starts_W.front().p, patient_axes()};
  for (const Pose& start_W : starts_W) led.hands_.push_back({start_W, 0});
  return led;
}

Result<void> LedHands::go_to_start(const std::function<void()>& step) {
  constexpr int kMostReads = 10000, kStill = 50;
  constexpr double kAtStart_m = 0.001;
  const Pose wanted_VD = mapping_.to_device(hands_.front().X_W);
  int still = 0;
  for (int i = 0; i < kMostReads && still < kStill; ++i) {
    user_->set_target(wanted_VD, Vec3::Zero(), 0);
    const DeviceSample sample = device_->read();
    device_->write_force(Vec3::Zero());
    if (!sample.connected) return fail(describe(ForceOff::kDisconnect), label_);
    const bool there = sample.calibrated && sample.refusal == ForceOff::kNone &&
                       (sample.X_VD.p - wanted_VD.p).norm() < kAtStart_m;
    still = there ? still + 1 : 0;
    if (step)
      step();
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (still == kStill) return {};
  return fail("the emulated hand does not reach where its part begins", label_,
              "Choose another device");
}

std::unique_ptr<HapticDevice> LedHands::take(std::size_t hand) {
  if (hands_.size() == 1) return std::move(device_);
  if (!share_) share_ = std::make_shared<HandShare>(std::move(device_), 0);
  return std::make_unique<SharedHand>(share_, hand, mapping_.to_device(hands_[hand].X_W));
}

bool LedHands::is_changing() const { return share_ && !share_->is_led(owner_); }

void LedHands::point_device(std::size_t hand, const Vec3& v_W, std::uint32_t buttons) {
  Pose X_VD = mapping_.to_device(hands_[hand].X_W);
  if (share_) X_VD = share_->to_device(hand, X_VD);
  user_->set_target(X_VD, mapping_.force_to_device(v_W) / mapping_.scale, buttons);
}

void LedHands::lead(std::size_t hand, const HandWill& will, double dt_s) {
  One& one = hands_[hand];
  const bool moving = moves(one.X_W, will.wanted());
  const Vec3 v_W = (will.wanted().p - one.X_W.p) / dt_s;
  one.X_W = will.wanted();
  one.rests_s = moving ? 0 : one.rests_s + dt_s;
  if (hand == owner_) {
    if (!is_changing()) point_device(hand, v_W, will.buttons());
    return;
  }
  if (!moving) return;
  if (hands_[owner_].rests_s < kRests_s || is_changing())
    return share_->set_rest(hand, mapping_.to_device(one.X_W));
  owner_ = hand;
  ++turns_;
  share_->give(hand);
}

}  // namespace osteon
