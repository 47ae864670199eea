#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// A piece of the way along which a hand shall be led, as the window knows it at a picture.
struct GuideLine {
  bool on = false;
  Vec3 p_W = Vec3::Zero();      ///< on the way, near the tip
  Vec3 along_W = Vec3::Zero();  ///< unit, along the way there; zero: the way rests at p_W
  double strength = 0;          ///< 0 to 1
};

/// Leads a hand: a weak spring from the tip to the nearest place of a line, across the line alone,
/// so that the hand goes along it as it likes. What it gives goes through the safety gate with the
/// rest of the force.
///
/// Symbols: e, from the tip to the line, across it; k = kStiffness_n_per_m; s, the strength;
/// f(e) = s min(k |e|, kMost_n) e / |e|; r, what is left of a jump.
/// Invariant: the force is f(e) + r, at most kMost_n. With a line that rests r is zero or shrinks,
/// and f comes from a potential that grows with |e|: the spring gives back no more than it took.
/// A line that moves (a new picture, a new step, on, off) would make f jump at a tip that rests:
/// r takes the jump over and goes to zero by kMostChange_n_per_s.
class HandGuide {
 public:
  static constexpr double kStiffness_n_per_m = 60;  // own default
  static constexpr double kMost_n = 0.8;            // own default; a touch is judged from 2 N on
  static constexpr double kMostChange_n_per_s = 2;

  /// On the hand, N. `tip_W`: where the hand wants the tip.
  Vec3 force_W(const GuideLine& line, const Vec3& tip_W, double dt_s);

 private:
  GuideLine line_;
  Vec3 rest_W_ = Vec3::Zero();
};

}  // namespace osteon
