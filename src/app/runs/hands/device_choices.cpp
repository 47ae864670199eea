#include "runs/hands/device_choices.h"

#include <algorithm>

#include "loops/path_hand.h"
#include "loops/path_player.h"
#include "osteon/device/drivers.h"

namespace osteon {
namespace {

constexpr const char* kVirtual = "virtual";

std::string label_of(const Driver& driver, const DeviceInfo& info) {
  if (std::string(driver.name) == kVirtual) return "Demonstration (virtual hand)";
  return info.serial.empty() ? info.name : info.name + " (" + info.serial + ")";
}

}  // namespace

bool plays_demo(const DeviceChoice& choice) { return choice.driver.starts_with(kVirtual); }

std::vector<DeviceChoice> list_device_choices(std::vector<std::string>* problems) {
  std::vector<DeviceChoice> choices;
  for (const Driver& driver : drivers()) {
    const auto devices = driver.list();
    if (!devices) {
      if (problems) problems->push_back(devices.error().message());
      continue;
    }
    for (const DeviceInfo& info : *devices)
      choices.push_back({label_of(driver, info), driver.name, info});
  }
  return choices;
}

std::string key_of(const DeviceChoice& choice) {
  return choice.info.serial.empty() ? choice.driver : choice.driver + ":" + choice.info.serial;
}

int find_choice(const std::vector<DeviceChoice>& choices, const std::string& key) {
  const auto first = [&](auto is_it) {
    const auto it = std::find_if(choices.begin(), choices.end(), is_it);
    return it == choices.end() ? -1 : static_cast<int>(it - choices.begin());
  };
  const int same = first([&](const DeviceChoice& c) { return key_of(c) == key; });
  if (same >= 0) return same;
  const std::string driver = key.substr(0, key.find(':'));
  return std::max(0, first([&](const DeviceChoice& c) { return c.driver == driver; }));
}

Result<std::unique_ptr<HapticDevice>> open_choice(const DeviceChoice& choice,
                                                  const ProbePath& demo) {
  if (plays_demo(choice) && demo.samples.empty())
    return fail("there is no path to play for this case", choice.label, "Choose another device");
  if (choice.driver == kVirtual) return std::make_unique<PathHand>(demo, choice.info);
  for (const Driver& driver : drivers()) {
    if (choice.driver != driver.name) continue;
    auto device = driver.open(choice.info);
    if (!device || !plays_demo(choice)) return device;
    auto player = PathPlayer::make(std::move(*device), demo);
    if (!player) return tl::unexpected(player.error());
    return std::move(*player);
  }
  return fail("there is no such driver", choice.driver, "Choose another device");
}

}  // namespace osteon
