#include "loops/tick_pacer.h"

namespace osteon {

std::int64_t TickPacer::next(std::int64_t now_ns) {
  deadline_ns_ += period_ns_;
  const std::int64_t late = now_ns - deadline_ns_;
  if (late >= period_ns_) {
    const std::int64_t skipped = late / period_ns_;
    missed_ += static_cast<std::uint64_t>(skipped);
    deadline_ns_ += skipped * period_ns_;
  }
  return deadline_ns_;
}

}  // namespace osteon
