// Devices of a live run: opened, kept open from run to run, shared between two hands.
#include <utility>

#include "loops/device_log.h"
#include "osteon/device/mouse_device.h"
#include "runs/hands/live_run.h"

namespace osteon {
namespace {

constexpr double kKept_s = 20;  // of a force log

// A device with motors and a pose of its own, which is not the program's.
bool is_real_device(const DeviceChoice& choice) {
  return choice.info.peak_force_n > 0 && !plays_demo(choice);
}

void remember_device(LiveHand& hand, HapticDevice& device) {
  // A list may know less than the open device, which has said what it is.
  hand.opened = device.info();
  hand.mouse = dynamic_cast<MouseDevice*>(&device);
  hand.pad = dynamic_cast<PadDevice*>(&device);
}

}  // namespace

bool LiveRun::by_real_device() const { return is_real_device(now().choice); }

// A real device stays open from run to run: it may have been homed by hand, and no other program
// shall have it in between.
Result<std::unique_ptr<HapticDevice>> LiveRun::open_device(LiveHand& hand) {
  std::unique_ptr<HapticDevice> held = std::move(hand.held);
  const bool same = hand.driver == hand.choice.driver && hand.serial == hand.choice.info.serial;
  hand.same_device = held && same && is_real_device(hand.choice) && held->read().connected;
  if (!same) hand.tripped = ForceOff::kNone;
  hand.driver = hand.choice.driver;
  hand.serial = hand.choice.info.serial;
  if (hand.same_device) return held;
  if (held) held->close();
  auto opened = open_choice(hand.choice, demo_);
  const bool logs = &hand == &hands_[0] && !force_log_.empty();
  if (!opened || !logs || hand.choice.info.peak_force_n <= 0) return opened;
  return std::make_unique<DeviceLog>(std::move(*opened), kKept_s, force_log_);
}

DeviceMapping LiveRun::mapping_at(const LiveHand& hand, const Pose& X_WD_start,
                                  HapticDevice& device) const {
  DeviceMapping mapping;
  if (plays_demo(hand.choice)) return mapping;
  mapping.X_WV = X_WD_start;
  if (!is_real_device(hand.choice)) return mapping;
  mapping.X_WV.q = hand.user.axes == MappingAxes::kPatient ? patient_axes() : q_WC_;
  mapping.scale = hand.user.scale;
  if (!hand.same_device) return mapping;
  // The hand is somewhere already, and there is where the probe was.
  const Pose X_VD = device.read().X_VD;
  if (is_finite(X_VD)) mapping.X_WV.p -= mapping.X_WV.q * (mapping.scale * X_VD.p);
  return mapping;
}

Result<std::vector<HandPlan>> LiveRun::make_hands(const std::vector<Pose>& X_WD_start) {
  std::vector<HandPlan> plans;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    LiveHand& hand = hands_[i];
    auto device = open_device(hand);
    if (!device) return tl::unexpected(device.error());
    remember_device(hand, **device);
    hand.mapping = mapping_at(hand, X_WD_start[i], **device);
    hand.X_WD_wanted = X_WD_start[i];
    HandPlan plan;
    plan.mapping = hand.mapping;
    if (is_real_device(hand.choice)) plan.mapping_settings = hand.user;
    plan.force_enabled = force_on_ && hand.tripped == ForceOff::kNone;
    plan.off_because = hand.tripped;
    plan.freezes = !plays_demo(hand.choice);
    plan.device = std::move(*device);
    plans.push_back(std::move(plan));
  }
  return plans;
}

// The first hand's device serves all; who rests does so in the device's own frame.
Result<std::vector<HandPlan>> LiveRun::make_shared_hands(const std::vector<Pose>& X_WD_start) {
  LiveHand& first = hands_[0];
  auto device = open_device(first);
  if (!device) return tl::unexpected(device.error());
  remember_device(first, **device);
  const DeviceMapping mapping = mapping_at(first, X_WD_start[active_], **device);
  PadDevice* const pad = first.pad;
  share_ = std::make_shared<HandShare>(std::move(*device), active_);
  std::vector<HandPlan> plans;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    LiveHand& hand = hands_[i];
    hand.opened = first.opened;
    hand.pad = pad;
    hand.mapping = mapping;
    hand.X_WD_wanted = X_WD_start[i];
    HandPlan plan;
    plan.mapping = mapping;
    if (is_real_device(hand.choice)) plan.mapping_settings = hand.user;
    plan.force_enabled = force_on_ && first.tripped == ForceOff::kNone;
    plan.off_because = first.tripped;
    plan.freezes = !plays_demo(first.choice);
    plan.device = std::make_unique<SharedHand>(share_, i, mapping.to_device(X_WD_start[i]));
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace osteon
