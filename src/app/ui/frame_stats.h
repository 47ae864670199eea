#pragma once

#include <string>
#include <vector>

namespace osteon {

/// Durations of the pictures, for the rate shown and for a measured run.
class FrameStats {
 public:
  void add(double frame_s);
  /// Pictures a second over the last half second; 0 before.
  double rate_hz() const { return rate_hz_; }
  double mean_ms() const;
  double quantile_ms(double q) const;
  std::size_t count() const { return frames_ms_.size(); }
  void clear();

 private:
  static constexpr std::size_t kKept = 100000;
  std::vector<float> frames_ms_;
  double rate_hz_ = 0;
  double window_s_ = 0;
  int window_frames_ = 0;
};

}  // namespace osteon
