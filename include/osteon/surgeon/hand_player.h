#pragma once

#include <string>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/command.h"

namespace osteon {

/// Somebody who plays a part of a scenario with one hand: says where the hand is wanted; the hand
/// itself (mass, grip) is the caller's.
class HandPlayer {
 public:
  virtual ~HandPlayer() = default;
  /// Where the hand begins.
  virtual Pose start() const = 0;
  /// Where the hand is wanted after another `dt_s`.
  virtual Pose step(double dt_s) = 0;
  /// The force on the hand in the same tick, N.
  virtual void feel(const Vec3& force_W) = 0;
  virtual bool done() const = 0;
  /// What it does beside moving in the tick of the last step: power, jaw.
  virtual Command command() { return {}; }
  /// Where the tip is wanted, for a hand that looks after it.
  virtual Vec3 tip_W() const { return Vec3::Zero(); }
  /// How many bones or places it is done with.
  virtual std::size_t touched() const { return 0; }
  /// Bones or marks that no free way leads to.
  virtual const std::vector<std::string>& unreachable() const = 0;
};

}  // namespace osteon
