#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "osteon/surgeon/scripted_hand.h"

namespace osteon {

/// What somebody asks of a knee beside what his hands do, one thing after the other: each once the
/// knee has answered the one before.
class KneeOrders {
 public:
  KneeOrders(double begin_s, double deg) : at_s_(begin_s), deg_(deg) {}
  void bend(double deg) {
    say({CommandKind::kBend, deg});
    at_s_ += std::abs(deg - deg_) / kBend_deg_per_s + kKneeAnswer_s;
    deg_ = deg;
  }
  /// On the graft's tail.
  void pull(double n) {
    say({CommandKind::kTension, n});
    at_s_ += kKneeAnswer_s;
  }
  /// Hands load the tibia, or let it go.
  void load(const Command& command) {
    say(command);
    at_s_ += kLoaded_s;
  }
  double now_s() const { return at_s_; }
  double bent_deg() const { return deg_; }
  std::vector<TimedCommand> take() { return std::move(orders_); }

 private:
  static constexpr double kBend_deg_per_s = 90, kKneeAnswer_s = 0.25;  // of the knee
  static constexpr double kLoaded_s = 0.7;                             // until a load is on, or off
  void say(const Command& command) { orders_.push_back({at_s_, command}); }
  double at_s_, deg_;
  std::vector<TimedCommand> orders_;
};

}  // namespace osteon
