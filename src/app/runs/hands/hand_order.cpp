#include "runs/hands/hand_order.h"

#include <algorithm>
#include <array>
#include <vector>

namespace osteon {

HandOrder parse_hand_order(const std::string& text) {
  HandOrder hand;
  const auto equals = text.find('=');
  if (equals != std::string::npos) hand.instrument = text.substr(equals + 1);
  const std::string device = text.substr(0, equals);
  const auto colon = device.find(':');
  hand.driver = device.substr(0, colon);
  const std::string which = colon == std::string::npos ? "" : device.substr(colon + 1);
  const bool is_hand = which == "left" || which == "right" || which == "third" || which == "fourth";
  (is_hand ? hand.name : hand.serial) = which;
  return hand;
}

Result<DeviceChoice> choice_of(const HandOrder& hand, std::span<const DeviceChoice> taken) {
  std::vector<std::string> problems;
  const auto is_taken = [&](const DeviceChoice& choice) {
    return std::any_of(taken.begin(), taken.end(), [&](const DeviceChoice& other) {
      return !choice.info.serial.empty() && other.driver == choice.driver &&
             other.info.serial == choice.info.serial;
    });
  };
  for (const DeviceChoice& choice : list_device_choices(&problems))
    if (choice.driver == hand.driver &&
        (hand.serial.empty() || choice.info.serial == hand.serial) && !is_taken(choice))
      return choice;
  std::string why;
  for (const std::string& problem : problems) why += "; " + problem;
  return fail("there is no such device, or another hand has it" + why,
              hand.serial.empty() ? hand.driver : hand.driver + ":" + hand.serial,
              "See `osteon devices`");
}

std::string name_of_hand(const HandOrder& order, std::size_t hand, std::size_t hands) {
  if (!order.name.empty() || hands == 1) return order.name;
  constexpr std::array kNames = {"left", "right", "third", "fourth"};
  return kNames[hand];
}

}  // namespace osteon
