#pragma once

#include <string>

#include "loops/hand_mapping.h"
#include "runs/hands/pedals.h"
#include "window/controllers/window_host.h"
#include "window/ui_requests.h"

namespace osteon {

struct HandModel;

/// Pedals and keys that stand for them, and which input drives which.
class PedalControl {
 public:
  explicit PedalControl(WindowHost& host) : host_(host) {}
  /// As the settings tie them.
  void begin() { pedals_.set_map(host_.settings.pedals); }
  /// Once a picture.
  HandWishes poll();
  double power() const { return pedals_.value(kPowerPedal); }
  void apply(const UiRequests& requests);
  void describe(HandModel& hand) const;

 private:
  void learn(const PedalReadings& now);

  WindowHost& host_;
  Pedals pedals_;
  std::string learning_;         ///< waits for the input that shall drive it; empty: none
  PedalReadings learning_from_;  ///< as all inputs were when the wait began
};

}  // namespace osteon
