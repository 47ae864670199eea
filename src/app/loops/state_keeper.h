#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "osteon/record/recording.h"
#include "osteon/session/session.h"

namespace osteon {

/// Collects states of a running session for its recording. Physics says when: it saves its part,
/// and each hand saves its own before the first tick that sees that step. The parts wait in places
/// made beforehand until a third thread has taken them; a moment at which a place is still full is
/// passed over. No loop waits, allocates or locks.
class StateKeeper {
 public:
  explicit StateKeeper(const Session& session);

  /// From the physics loop, after a step that is to be kept.
  void keep_world(const Session& session);
  /// From a hand's loop, before its tick: `saved_step` as the bones that the tick will see have it,
  /// `seen` the tools that it will see.
  void keep_hand(const Session& session, std::size_t hand, std::uint64_t saved_step,
                 const OtherTools& seen);

  /// From one other thread: a state whose parts are all there, or none.
  std::optional<StoredState> take();

 private:
  template <class State>
  struct alignas(64) Place {
    State state;
    std::uint64_t step = 0;       // written before `full` is set
    std::uint64_t last_step = 0;  // of the loop that fills it
    std::atomic<bool> full{false};
  };
  Place<WorldState> world_;
  std::array<std::unique_ptr<Place<HandState>>, kMaxHands> hands_;
  std::size_t count_;
};

}  // namespace osteon
