#pragma once

#include <array>
#include <span>
#include <vector>

#include "osteon/scene/case.h"

namespace osteon {

/// One touch of one bone, without a break longer than kBreakS.
struct ContactSpan {
  BoneId bone;
  double start_s = 0, end_s = 0;
  float peak_force_n = 0;
};

/// Touches by bone, gathered as time goes by.
class ContactTimeline {
 public:
  static constexpr double kBreakS = 0.05;
  ContactTimeline() { open_.fill(kNone); }
  /// The touched bones (bit i: bone i) at a time not before the last one.
  void add(double time_s, std::uint64_t bones_mask, float peak_force_n);
  /// Puts in the touches of another stretch of time; one that goes on in it is one. Nothing is
  /// added after that.
  void join(const ContactTimeline& other);
  void clear();
  std::span<const ContactSpan> spans() const { return spans_; }
  double end_s() const { return end_s_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<ContactSpan> spans_;
  std::array<std::size_t, kMaxBones> open_;  ///< index of each bone's newest span
  double end_s_ = 0;
};

}  // namespace osteon
