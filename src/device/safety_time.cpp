#include "osteon/device/safety_time.h"

#include <algorithm>

namespace osteon {
namespace {

// After a stall of the loop itself the device's reader gets a few ticks to catch up: one long tick
// does not make a device silent.
constexpr double kLongestCountedTick_s = 0.002;

}  // namespace

double ForceRamp::advance(double age_s, double dt_s) {
  const double risen = ramp_in_s_ > 0 ? gain_ + dt_s / ramp_in_s_ : 1;
  const double stale_s = std::max(0.0, age_s - stale_after_s_);
  const double fresh = stale_decay_s_ > 0 ? 1 - stale_s / stale_decay_s_ : (stale_s > 0 ? 0 : 1);
  gain_ = std::clamp(std::min(risen, fresh), 0.0, 1.0);
  return gain_;
}

void SilenceWatch::restart() {
  seen_ = false;
  silent_s_ = 0;
}

void SilenceWatch::see(std::int64_t reading_time_ns, double dt_s) {
  if (!seen_ || reading_time_ns > newest_ns_) {
    newest_ns_ = reading_time_ns;
    seen_ = true;
    silent_s_ = 0;
  } else {
    silent_s_ += std::min(dt_s, kLongestCountedTick_s);
  }
}

}  // namespace osteon
