#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "event_list.h"
#include "osteon/base/bounded_queue.h"
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
using CarveChannel = BoundedQueue<CarvePatch>;
/// Room for a whole bone that comes back, and a second of drilling besides.
inline constexpr std::size_t kCarveChannelPlaces = 8192;

/// One hand's own copy of the cuts, as they were after the step that its tick consumes: a function
/// of which step each tick consumed, so that a replay feels the same.
class FeltCuts {
 public:
  explicit FeltCuts(const CarvingSetup& setup);

  CarveChannel& channel() { return channel_; }
  /// Of each bone; null: it is not carved.
  std::vector<const CutField*> by_bone() const;
  /// Takes over all changes up to that step. Allocates, locks and logs nothing.
  void take_until(std::uint64_t step, std::uint64_t tick, EventList& events);
  /// Throws away what is on its way and copies all cuts. While all threads rest.
  void copy(const Carving& carving);

 private:
  void apply(const CarvePatch& patch, std::uint64_t tick, EventList& events);

  std::vector<std::unique_ptr<CutField>> bones_;
  CarveChannel channel_{kCarveChannelPlaces};
  CarvePatch next_;
  bool waiting_ = false;  ///< `next_` belongs to a later step
};

/// Tells every hand what the last step has changed; `all`: every block. False: a hand has not
/// listened for so long that there is no room.
bool publish(const Carving& carving, std::uint64_t step, bool all, std::vector<FeltCuts*>& hands);

}  // namespace osteon
