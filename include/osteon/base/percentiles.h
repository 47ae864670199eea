#pragma once

#include <array>
#include <cstdint>

namespace osteon {

/// Histogram of durations with 1 % wide logarithmic bins from 1 ns to 10 s. Fixed size: adding
/// allocates nothing, so the haptic tick may do it.
class Percentiles {
 public:
  void add_ns(std::int64_t ns);
  /// Duration that the share `q` in [0, 1] of the samples does not exceed; 0 without samples.
  double quantile_ns(double q) const;
  double max_ns() const { return static_cast<double>(max_); }
  std::uint64_t count() const { return count_; }

 private:
  static constexpr int kBins = 2400;
  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ = 0;
};

}  // namespace osteon
