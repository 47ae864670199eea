#pragma once

#include <vector>

#include "osteon/scene/soft_solid.h"

namespace osteon {

/// What pressed soft solids in a repeated recording, 60 times a second, kept where it changed.
class PushHistory {
 public:
  static constexpr double kPictureHz = 60;
  /// As things stand after `time_s`; in the order of time.
  void add(const SolidPushes& pushes, double time_s);
  /// The last that was kept until then; before the first: nothing presses.
  SolidPushes at(double time_s) const;
  std::size_t kept() const { return kept_.size(); }

 private:
  struct Kept {
    double time_s = 0;
    std::vector<SolidPushes::One> all;
  };
  std::vector<Kept> kept_;
  double due_s_ = 0;  ///< of the next that is looked at
};

}  // namespace osteon
