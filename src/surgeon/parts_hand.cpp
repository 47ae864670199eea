#include "osteon/surgeon/parts_hand.h"

#include <utility>

namespace osteon {
namespace {

std::vector<std::unique_ptr<HandPlayer>> alone(std::unique_ptr<HandPlayer> player) {
  std::vector<std::unique_ptr<HandPlayer>> players;
  players.push_back(std::move(player));
  return players;
}

}  // namespace

PartsHand::PartsHand(std::vector<std::unique_ptr<HandPlayer>> first, std::vector<Plan> parts)
    : first_(std::move(first)), parts_(std::move(parts)), X_(first_.front()->start()) {}

PartsHand::PartsHand(std::unique_ptr<HandPlayer> first, std::vector<Plan> parts)
    : PartsHand(alone(std::move(first)), std::move(parts)) {}

void PartsHand::begin_part(double dt_s) {
  if (auto planned = parts_[at_](X_)) {
    part_.emplace(std::move(*planned));
    part_->set_tray(tray_);
    waited_s_ = 0;
    return;
  }
  waited_s_ += dt_s;
  if (waited_s_ > patience_s_) at_ = parts_.size();
}

Pose PartsHand::step(double dt_s) {
  next_ = {};
  while (now_ < first_.size() && first_[now_]->done()) ++now_;
  if (now_ < first_.size()) {
    X_ = first_[now_]->step(dt_s);
    next_ = first_[now_]->command();
    return X_;
  }
  if (done()) return X_;
  if (!part_) begin_part(dt_s);
  if (!part_) return X_;
  X_ = part_->step(dt_s);
  next_ = part_->command();
  if (!part_->done()) return X_;
  part_.reset();
  ++at_;
  return X_;
}

void PartsHand::feel(const Vec3& force_W) {
  if (now_ < first_.size()) first_[now_]->feel(force_W);
}

}  // namespace osteon
