#include "runs/reports/contact_timeline.h"

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

void ContactTimeline::join(const ContactTimeline& other) {
  for (ContactSpan span : other.spans_) {
    const auto goes_on = [&](const ContactSpan& known) {
      return known.bone == span.bone && known.start_s <= span.end_s + kBreakS &&
             span.start_s <= known.end_s + kBreakS;
    };
    for (const ContactSpan& known : spans_) {
      if (!goes_on(known)) continue;
      span.start_s = std::min(span.start_s, known.start_s);
      span.end_s = std::max(span.end_s, known.end_s);
      span.peak_force_n = std::max(span.peak_force_n, known.peak_force_n);
    }
    std::erase_if(spans_, goes_on);
    spans_.push_back(span);
  }
  open_.fill(kNone);
  end_s_ = std::max(end_s_, other.end_s_);
}

void ContactTimeline::clear() { *this = ContactTimeline(); }

}  // namespace osteon
