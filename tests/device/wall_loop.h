#pragma once

#include "osteon/device/haptic_device.h"
#include "osteon/device/safety.h"

namespace osteon::testing {

/// The 1 kHz loop of a program with nothing in it but a wall, behind the safety gate.
struct WallLoop {
  explicit WallLoop(HapticDevice& the_device) : device(the_device), gate(the_device.info()) {}

  /// One tick: read, push out of the wall, guard, write.
  void tick() {
    sample = device.read();
    const double depth = sample.X_VD.p.x() - wall_x_m;
    const Vec3 push = depth > 0 ? Vec3(-stiffness_n_per_m * depth, 0, 0) : Vec3::Zero();
    wished = add_nan ? Vec3(std::nan(""), 0, 0) : push;
    given = gate.filter(wished, sample, 0, 0.001);
    device.write_force(given);
  }

  HapticDevice& device;
  SafetyGate gate;
  double wall_x_m = 0;
  double stiffness_n_per_m = 800;
  bool add_nan = false;
  DeviceSample sample;
  Vec3 wished = Vec3::Zero();
  Vec3 given = Vec3::Zero();
};

}  // namespace osteon::testing
