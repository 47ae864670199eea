#include "ui/frame_stats.h"

#include <algorithm>
#include <numeric>

namespace osteon {

void FrameStats::add(double frame_s) {
  if (frames_ms_.size() < kKept) frames_ms_.push_back(static_cast<float>(frame_s * 1e3));
  window_s_ += frame_s;
  ++window_frames_;
  if (window_s_ < 0.5) return;
  rate_hz_ = window_frames_ / window_s_;
  window_s_ = 0;
  window_frames_ = 0;
}

double FrameStats::mean_ms() const {
  if (frames_ms_.empty()) return 0;
  return std::accumulate(frames_ms_.begin(), frames_ms_.end(), 0.0) /
         static_cast<double>(frames_ms_.size());
}

double FrameStats::quantile_ms(double q) const {
  if (frames_ms_.empty()) return 0;
  std::vector<float> sorted = frames_ms_;
  std::sort(sorted.begin(), sorted.end());
  const double last = static_cast<double>(sorted.size() - 1);
  return static_cast<double>(
      sorted[static_cast<std::size_t>(std::clamp(q, 0.0, 1.0) * last + 0.5)]);
}

void FrameStats::clear() { *this = FrameStats(); }

}  // namespace osteon
