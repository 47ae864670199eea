#include "felt_bands.h"

namespace osteon {

void FeltBands::take_until(std::uint64_t step, std::uint64_t tick, EventList& events) {
  while (waiting_ || channel_.pop(next_)) {
    waiting_ = next_.step > step;
    if (waiting_) return;
    if (!next_.is_event) {
      contacts_ = next_.contacts;
      continue;
    }
    next_.event.tick = tick;
    events.add(next_.event);
  }
}

void FeltBands::copy(const BandContacts& contacts) {
  while (channel_.pop(next_)) {
  }
  waiting_ = false;
  contacts_ = contacts;
}

SoftHalf::SoftHalf(std::unique_ptr<SoftWorld> world, std::vector<FeltBands*> hands)
    : world_(std::move(world)), hands_(std::move(hands)) {}

void SoftHalf::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                    std::span<const CarvedField* const> carved) {
  if (!heard_) return;
  world_->step(tools, bones, carved);
  publish(bones.step);
}

// An event of no hand is told to the first one.
void SoftHalf::publish(std::uint64_t step) {
  BandNews news;
  news.step = step;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    news.contacts = world_->contacts(h);
    if (news.contacts == told_[h]) continue;
    told_[h] = news.contacts;
    heard_ = hands_[h]->channel().push(news) && heard_;
  }
  news.is_event = true;
  for (const Event& event : world_->events()) {
    const std::size_t hand = event.hand < hands_.size() ? event.hand : 0;
    news.event = event;
    heard_ = hands_[hand]->channel().push(news) && heard_;
  }
}

void SoftHalf::restore(const SoftState& state, std::uint32_t epoch) {
  world_->restore(state, epoch);
  for (std::size_t h = 0; h < hands_.size(); ++h) hands_[h]->copy(told_[h] = world_->contacts(h));
  heard_ = true;
}

}  // namespace osteon
