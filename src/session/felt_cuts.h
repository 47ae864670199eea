#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "event_list.h"
#include "osteon/base/warm_queue.h"
#include "osteon/haptic/haptic.h"
#include "osteon/physics/carving.h"

namespace osteon {

/// From physics to one hand: what a step has changed of carved bone, and what happened in it.
struct CarvePatch {
  enum class Kind : std::uint8_t { kBlock, kClear, kEvent };
  std::uint64_t step = 0;
  Kind kind = Kind::kBlock;
  std::uint32_t bone = 0, block = 0;
  std::array<std::int16_t, CutField::kNodes> cut{};
  Event event;
};
using CarveChannel = WarmQueue<CarvePatch>;
/// Room for all blocks of a bone that comes back, for each bone, and a second of drilling besides.
std::size_t channel_places(const CarvingSetup& setup);

/// One hand's own copy of the cuts, as they were after the step that its tick consumes: a function
/// of which step each tick consumed, so that a replay feels the same. Nothing that physics
/// tells is lost: what has no room in the channel, because the hand has not ticked for long, waits
/// with physics, and until it has gone into the channel the hand is given no snapshot of its steps.
class FeltCuts {
 public:
  explicit FeltCuts(const CarvingSetup& setup) : FeltCuts(setup, channel_places(setup)) {}
  FeltCuts(const CarvingSetup& setup, std::size_t places);

  // Of the hand.
  /// Of each bone; null: it is not carved.
  std::vector<const CutField*> by_bone() const;
  /// Takes over all changes up to that step. Allocates, locks and logs nothing.
  void take_until(std::uint64_t step, std::uint64_t tick, EventList& events);

  // Of physics.
  /// Allocates where there is no room.
  void tell(const CarvePatch& patch);
  /// Sends what waits, as far as there is room.
  void send_late();
  bool behind() const { return !late_.empty(); }

  // Of one thread that runs both, or while all rest.
  /// Makes room until nothing waits.
  void catch_up();
  /// Throws away what is on its way and copies all cuts.
  void copy(const Carving& carving);

 private:
  const CarvePatch* next() const;
  void drop_next();
  void apply(const CarvePatch& patch, std::uint64_t tick, EventList& events);

  std::vector<std::unique_ptr<CutField>> bones_;
  std::deque<CarvePatch> early_;  ///< out of the channel before their time, see catch_up
  CarveChannel channel_;
  std::deque<CarvePatch> late_;  ///< physics' own
};

/// Tells every hand what the last step has changed; `all`: every block.
void publish(const Carving& carving, std::uint64_t step, bool all, std::vector<FeltCuts*>& hands);

}  // namespace osteon
