#include "osteon/surgeon/parts_hand.h"

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

constexpr double kPartPatience_s = 3;

}  // namespace

PartsHand::PartsHand(std::unique_ptr<HandPlayer> first, std::vector<Plan> parts)
    : first_(std::move(first)), parts_(std::move(parts)), X_(first_->start()) {}

void PartsHand::begin_part(double dt_s) {
  part_ = parts_[at_](X_);
  if (part_) {
    time_s_ = waited_s_ = 0;
    order_ = 0;
    held_ = part_->path.samples.empty() ? "" : part_->path.samples.front().instrument;
    power_ = jaw_ = 0;
    return;
  }
  waited_s_ += dt_s;
  if (waited_s_ > kPartPatience_s) at_ = parts_.size();
}

// One command a tick: what is asked for waits while the hand itself does something.
Command PartsHand::said() {
  const PathSample sample = part_->path.at(time_s_);
  if (!sample.instrument.empty() && sample.instrument != held_) {
    held_ = sample.instrument;
    power_ = jaw_ = 0;  // as one takes it
    const auto found = std::find(tray_.begin(), tray_.end(), held_);
    if (found != tray_.end())
      return {CommandKind::kTake, static_cast<double>(found - tray_.begin())};
  }
  if (sample.power != power_) {
    power_ = sample.power;
    return {CommandKind::kPower, power_};
  }
  if (sample.jaw != jaw_) {
    jaw_ = sample.jaw;
    return {CommandKind::kJaw, jaw_};
  }
  if (order_ >= part_->orders.size() || part_->orders[order_].at_s > time_s_) return {};
  return part_->orders[order_++].command;
}

Pose PartsHand::step(double dt_s) {
  next_ = {};
  if (!first_->done()) {
    X_ = first_->step(dt_s);
    next_ = first_->command();
    return X_;
  }
  if (done()) return X_;
  if (!part_) begin_part(dt_s);
  if (!part_) return X_;
  time_s_ += dt_s;
  X_ = part_->path.at(time_s_).X_WD;
  next_ = said();
  const bool more = order_ < part_->orders.size();
  if (time_s_ > part_->path.duration_s() && !more) {
    part_.reset();
    ++at_;
  }
  return X_;
}

}  // namespace osteon
