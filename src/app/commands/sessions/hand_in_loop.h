#pragma once

#include <memory>
#include <string>

#include "osteon/base/result.h"
#include "osteon/device/virtual_hand.h"
#include "osteon/haptic/haptic.h"
#include "osteon/scene/command.h"
#include "osteon/scene/path.h"

namespace osteon {

/// Whoever moves the tool in a headless run, and feels its force.
class HandInLoop {
 public:
  virtual ~HandInLoop() = default;
  /// The hand one tick later.
  virtual ToolInput move() = 0;
  /// Force of that tick, N.
  virtual void feel(const Vec3& force_W) = 0;
  /// Some rotation is driven: `turn` tells the torque before `feel` tells the force.
  virtual bool drives_rotation() const { return false; }
  /// Torque of that tick about the tool's origin, N m.
  virtual void turn(const Vec3& torque_W) { (void)torque_W; }
  /// What it does beside moving, in the tick of the last move.
  virtual Command command() { return {}; }
  /// Why it no longer feels the force; empty: it does.
  virtual std::string complaint() const { return {}; }
};

/// The emulated hand itself, without a device.
std::unique_ptr<HandInLoop> free_hand(const ProbePath& path, const HandParams& hand, double tick_s);

/// The emulated user of a device of that driver, through the driver, with the safety gate between.
/// The settings are kept within what the device bears. Returns when the hand is at the path's start
/// and the force is past its ramp.
Result<std::unique_ptr<HandInLoop>> hand_on_device(const std::string& driver, const ProbePath& path,
                                                   HapticParams& haptic);

}  // namespace osteon
