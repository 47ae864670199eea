#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "commands/support/headless.h"
#include "loops/loop_exchange.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// A device whose user is emulated, and led by a virtual surgeon.
struct LedDevice {
  std::string label;  ///< as the user names it
  std::unique_ptr<HapticDevice> device;
};

/// How a live run went.
struct LivePlayed {
  struct Hand {
    std::string name, device;
    LoopStats loop;
    double peak_force_n = 0;  ///< that the gate gave
  };
  std::vector<Hand> hands;
  LoopStats physics;
  double duration_s = 0;      ///< of the session
  double wall_s = 0;          ///< that passed meanwhile
  double waited_s = 0;        ///< while a device went over to another hand or a force came back
  std::uint64_t resumed = 0;  ///< how often a force was switched on again after a watchdog's trip
  std::uint64_t turns = 0;    ///< how often a device went over to another hand
  std::string broken_off;     ///< why it ended early; empty: it did not
};
std::string to_text(const LivePlayed& played);

/// Plays a run's hands on devices in real time: a loop of 1 kHz for each hand and one of physics on
/// their threads, and whoever plays on the caller's, who leads the emulated users of the devices,
/// says what the hands' paths and players say, and feels what the session's hands feel. Devices are
/// the hands' in their order; the last one serves all hands that are left, one after the other: it
/// goes over to a hand that begins to move once the other has come to rest. What `run` says of
/// forces and of the hand's impedance is left to the devices. Needs `record_to`.
///
/// Ends with the run's last path and player, or when it is over. A device that is lost or refuses
/// ends it early: all forces are zero then, what was recorded stays. Fails when a device's user is
/// a real one, when there are fewer devices than hands at work at once, or when a device cannot be
/// brought to where its hand begins.
///
/// With `step_devices`, which moves the devices' own time on by a tick, no thread and no clock is
/// needed: all loops take their turns on the caller's thread, as fast as it goes.
Result<LivePlayed> play_live(const HeadlessRun& run, std::vector<LedDevice> devices,
                             const std::function<void()>& step_devices = {});

}  // namespace osteon
