#include "loops/state_keeper.h"

namespace osteon {

// Filled once here, so that filling it again allocates nothing.
StateKeeper::StateKeeper(const Session& session) : count_(session.hands()) {
  session.save_world(world_.state);
  for (std::size_t h = 0; h < count_; ++h) {
    hands_[h] = std::make_unique<Place<HandState>>();
    session.save_hand(h, hands_[h]->state);
  }
}

void StateKeeper::keep_world(const Session& session) {
  if (world_.full.load(std::memory_order_acquire)) return;
  session.save_world(world_.state);
  world_.step = world_.state.bones.step;
  world_.full.store(true, std::memory_order_release);
}

void StateKeeper::keep_hand(const Session& session, std::size_t hand, std::uint64_t saved_step,
                            const OtherTools& seen) {
  Place<HandState>& place = *hands_[hand];
  if (saved_step == place.last_step) return;
  place.last_step = saved_step;
  if (place.full.load(std::memory_order_acquire)) return;
  session.save_hand(hand, place.state);
  place.state.seen = seen;
  place.step = saved_step;
  place.full.store(true, std::memory_order_release);
}

// A part that belongs to an older moment than another has missed the others: it makes room.
std::optional<StoredState> StateKeeper::take() {
  if (!world_.full.load(std::memory_order_acquire)) return std::nullopt;
  bool all = true;
  for (std::size_t h = 0; h < count_; ++h) {
    Place<HandState>& place = *hands_[h];
    if (!place.full.load(std::memory_order_acquire)) {
      all = false;
    } else if (place.step < world_.step) {
      place.full.store(false, std::memory_order_release);
      all = false;
    } else if (place.step > world_.step) {
      world_.full.store(false, std::memory_order_release);
      return std::nullopt;
    }
  }
  if (!all) return std::nullopt;
  SessionState state;
  StoredState stored;
  state.world = world_.state;
  stored.step = world_.step;
  for (std::size_t h = 0; h < count_; ++h) {
    state.hands.push_back(hands_[h]->state);
    stored.ticks[h] = hands_[h]->state.haptic.tool.tick;
    hands_[h]->full.store(false, std::memory_order_release);
  }
  world_.full.store(false, std::memory_order_release);
  stored.bytes = to_bytes(state);
  return stored;
}

}  // namespace osteon
