#pragma once

#include "osteon/scene/command.h"
#include "osteon/scene/path.h"

namespace osteon {

/// Power and jaws along a path, as commands: one a tick, power first.
class PathDrive {
 public:
  /// An instrument is taken unpowered, its jaws shut.
  void took() { power_ = jaw_ = 0; }
  /// What has changed; none where nothing has.
  Command next(const PathSample& sample) {
    if (sample.power != power_) {
      power_ = sample.power;
      return {CommandKind::kPower, power_};
    }
    if (sample.jaw != jaw_) {
      jaw_ = sample.jaw;
      return {CommandKind::kJaw, jaw_};
    }
    return {};
  }

 private:
  double power_ = 0, jaw_ = 0;
};

}  // namespace osteon
