#pragma once

#include <cstdint>
#include <optional>

namespace osteon {

/// The switch in an arm's inkwell, among the buttons of its samples.
inline constexpr int kInkwellButton = 8;

/// Tells visits of a stylus to its inkwell. Arms differ in which state of the switch means that the
/// stylus is in it: what counts is that it went one way and came back.
class InkwellVisits {
 public:
  /// Once for each sample, in order. True with the one that ends a visit.
  bool ended(std::uint32_t buttons) {
    const bool now = ((buttons >> kInkwellButton) & 1u) != 0;
    if (!at_rest_) at_rest_ = last_ = now;
    const bool back = now != last_ && now == *at_rest_;
    last_ = now;
    return back;
  }

 private:
  std::optional<bool> at_rest_;  ///< how it was first
  bool last_ = false;
};

}  // namespace osteon
