#include "runs/contact_timeline.h"

#include <algorithm>
#include <bit>

namespace osteon {

void ContactTimeline::add(double time_s, std::uint64_t bones_mask, float peak_force_n) {
  end_s_ = time_s;
  for (std::uint64_t rest = bones_mask; rest != 0; rest &= rest - 1) {
    const auto bone = static_cast<std::uint32_t>(std::countr_zero(rest));
    std::size_t& open = open_[bone];
    if (open == kNone || time_s - spans_[open].end_s > kBreakS) {
      open = spans_.size();
      spans_.push_back({BoneId{bone}, time_s, time_s, 0});
    }
    spans_[open].end_s = time_s;
    spans_[open].peak_force_n = std::max(spans_[open].peak_force_n, peak_force_n);
  }
}

void ContactTimeline::clear() { *this = ContactTimeline(); }

}  // namespace osteon
