#pragma once

#include <span>
#include <string>

#include "osteon/base/result.h"
#include "runs/hands/device_choices.h"

namespace osteon {

/// A hand as the command line names it: "phantom", "phantom:serial", "phantom:left", and after any
/// of them "=hook_probe".
struct HandOrder {
  std::string driver;
  std::string serial;
  std::string name;        ///< of the hand; empty: not named
  std::string instrument;  ///< as a tray names it; empty: the wrist probe
};
HandOrder parse_hand_order(const std::string& text);

/// The device of that hand among those that can be opened now; one that another hand has is not
/// looked at. Fails when there is none left.
Result<DeviceChoice> choice_of(const HandOrder& hand, std::span<const DeviceChoice> taken);

/// The first two hands are left and right where nobody says otherwise; one alone has no name.
std::string name_of_hand(const HandOrder& order, std::size_t hand, std::size_t hands);

}  // namespace osteon
