// A reamer that cuts deep into the wall of a canal shakes.
#include <cmath>

#include "carving_push.h"
#include "cutter_front.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

using namespace carving;

// Told when it begins and when it has become another one.
void Carving::shake(std::size_t hand, const CarvingTool& with, const Push& push, double rev_per_s) {
  constexpr double kOther = 0.5, kLeast_m = 5e-6;
  CarvingHand& h = hands_[hand];
  const double depth = cut_a_side(*bones_[h.bone].field, with.cutter, cutter_pose(h));
  const double canal = with.cutter.size_m - 2 * depth;
  const auto now = reamer_chatter(setup_->table, with.cutter.size_m, canal, rev_per_s, depth > 0);
  if (!now || now->amplitude_m < kLeast_m) return run_smoothly(hand, push);
  const auto alike = [](double a, double b) { return std::abs(a - b) <= kOther * b; };
  if (alike(now->amplitude_m, h.chatter.amplitude_m) &&
      alike(now->frequency_hz, h.chatter.frequency_hz))
    return;
  if (!(h.chatter.amplitude_m > 0)) h.chatters_since = steps_;
  h.chatter = *now;
  tell(hand, push, kChatter, {1000 * now->amplitude_m, now->frequency_hz, 0});
}

void Carving::run_smoothly(std::size_t hand, const Push& push) {
  CarvingHand& h = hands_[hand];
  if (!(h.chatter.amplitude_m > 0)) return;
  h.chatter = {};
  const double seconds = kStep_s * static_cast<double>(steps_ - h.chatters_since);
  tell_of(hand, *push.tool, kChatterEnd, h.bone, {seconds, 0, 0});
}

}  // namespace osteon
