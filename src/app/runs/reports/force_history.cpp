#include "runs/reports/force_history.h"

#include <algorithm>

namespace osteon {

ForceHistory::ForceHistory(double seconds)
    : length_(static_cast<std::size_t>(seconds * kForceHistoryHz)), buffer_(2 * length_, 0.0f) {}

void ForceHistory::add(float force_n) {
  if (start_ == length_) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(length_), buffer_.end(),
              buffer_.begin());
    start_ = 0;
  }
  buffer_[start_ + length_] = force_n;
  ++start_;
}

void ForceHistory::clear() {
  std::fill(buffer_.begin(), buffer_.end(), 0.0f);
  start_ = 0;
}

}  // namespace osteon
