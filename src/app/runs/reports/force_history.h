#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace osteon {

inline constexpr double kForceHistoryHz = 250;

/// The last few seconds of force, oldest first, for the plot.
class ForceHistory {
 public:
  explicit ForceHistory(double seconds = 8);
  void add(float force_n);
  void clear();
  /// Always of the full length: zeros before the first point.
  std::span<const float> values() const { return {buffer_.data() + start_, length_}; }

 private:
  std::size_t length_;
  std::size_t start_ = 0;
  std::vector<float> buffer_;  ///< twice the length: values() is one piece without copying a point
};

}  // namespace osteon
