#pragma once

#include "osteon/base/types.h"

namespace osteon {

struct ChatterParams {
  double smallest_m = 0.00015;        ///< swings smaller than this are left alone
  double slowest_half_s = 0.110;      ///< a half swing that takes longer is the user's own motion
  double longest_bounce_s = 0.060;    ///< so is a contact that lasts longer
  double least_speed_m_per_s = 0.02;  ///< slower bounces are left alone
};

/// Finds swings of one axis that neither die down nor are the user's own: turns of the motion that
/// come fast one after the other, each about as large as the one before.
class SwingWatch {
 public:
  /// One tick with the force on this axis. 0, or when a swing has just ended that did not die down
  /// its size as a share of the last one's.
  double see(double x_m, double force_n, double dt_s, const ChatterParams& params);

 private:
  bool turned(double x_m);

  bool started_ = false;
  double extreme_m_ = 0;    ///< farthest point of the swing under way
  double last_turn_m_ = 0;  ///< where it began
  int direction_ = 0;
  double swing_s_ = 0;
  bool loaded_ = false;  ///< a force acted during it
  double previous_m_ = 0;
  int fast_turns_ = 0;
};

/// Finds short contacts that give back as much speed as they took, or more: a wall cannot.
class BounceWatch {
 public:
  /// One tick. 0, or when such a contact has just ended its speed out as a share of that in.
  double see(const Vec3& v_V, const Vec3& force_V, double dt_s, const ChatterParams& params);

 private:
  bool touching_ = false;
  double contact_s_ = 0;
  Vec3 normal_V_ = Vec3::Zero();
  double speed_in_ = 0;
};

/// Least force that counts as contact, N.
inline constexpr double kTouch_n = 0.05;

}  // namespace osteon
