#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "event_list.h"
#include "osteon/base/bounded_queue.h"
#include "osteon/haptic/haptic.h"
#include "osteon/physics/soft_world.h"

namespace osteon {

/// From physics to one hand: the bands near it after a step, or what happened to one.
struct BandNews {
  std::uint64_t step = 0;
  bool is_event = false;
  BandContacts contacts;
  Event event;
};
using BandChannel = BoundedQueue<BandNews>;
/// A hand may be late by four seconds of contact.
inline constexpr std::size_t kBandChannelPlaces = 2048;

/// One hand's own copy of what is near it, as it was after the step that its tick consumes: a
/// function of which step each tick consumed, so that a replay feels the same.
class FeltBands {
 public:
  BandChannel& channel() { return channel_; }
  const BandContacts& contacts() const { return contacts_; }
  /// Takes over the news of all steps up to that one. Allocates, locks and logs nothing.
  void take_until(std::uint64_t step, std::uint64_t tick, EventList& events);
  /// Throws away what is on its way. While all threads rest.
  void copy(const BandContacts& contacts);

 private:
  BandChannel channel_{kBandChannelPlaces};
  BandContacts contacts_;
  BandNews next_;
  bool waiting_ = false;  ///< `next_` belongs to a later step
};

/// The soft parts of a session with who feels them.
class SoftHalf {
 public:
  SoftHalf(std::unique_ptr<SoftWorld> world, std::vector<FeltBands*> hands);

  const SoftWorld& world() const { return *world_; }
  void bare_skin(SkinBare bares) { world_->bare_skin(bares); }
  /// Steps, and tells the hands what has changed for them. A hand that has not listened for so long
  /// that there is no room would miss what changes: nothing is stepped after that, as with cuts.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            std::span<const CarvedField* const> carved);
  void restore(const SoftState& state, std::uint32_t epoch);
  void go_back(const SoftState& state, std::uint32_t epoch) { world_->go_back(state, epoch); }

 private:
  void publish(std::uint64_t step);

  std::unique_ptr<SoftWorld> world_;
  std::vector<FeltBands*> hands_;
  std::array<BandContacts, kMaxHands> told_{};
  bool heard_ = true;
};

}  // namespace osteon
