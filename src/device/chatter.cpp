#include "osteon/device/chatter.h"

#include <cmath>

namespace osteon {
namespace {

constexpr double kTurn_m = 0.00002;  // way back that counts as a turn: above a sensor's noise
constexpr double kDyingDown = 0.9;   // a swing or a bounce smaller than this share dies down
constexpr int kTurnsOfChatter = 3;   // a bounce has two

}  // namespace

// Notes the farthest point; true when the motion has come back from it far enough.
bool SwingWatch::turned(double x_m) {
  if (direction_ == 0 && std::abs(x_m - extreme_m_) > kTurn_m)
    direction_ = x_m > extreme_m_ ? 1 : -1;
  if (direction_ == 0) return false;
  if (direction_ * (x_m - extreme_m_) >= 0) {
    extreme_m_ = x_m;
    return false;
  }
  return std::abs(x_m - extreme_m_) > kTurn_m;
}

double SwingWatch::see(double x_m, double force_n, double dt_s, const ChatterParams& params) {
  if (!started_) {
    started_ = true;
    extreme_m_ = last_turn_m_ = x_m;
  }
  swing_s_ += dt_s;
  loaded_ = loaded_ || std::abs(force_n) > kTouch_n;
  if (!turned(x_m)) return 0;

  const double swing_m = std::abs(extreme_m_ - last_turn_m_);
  const bool fast = loaded_ && swing_s_ < params.slowest_half_s;
  fast_turns_ = fast && swing_m > params.smallest_m ? fast_turns_ + 1 : 0;
  const double growth = previous_m_ > 0 ? swing_m / previous_m_ : 0;
  previous_m_ = swing_m;
  last_turn_m_ = extreme_m_;
  extreme_m_ = x_m;
  direction_ = -direction_;
  swing_s_ = 0;
  loaded_ = std::abs(force_n) > kTouch_n;
  return fast_turns_ >= kTurnsOfChatter && growth > kDyingDown ? growth : 0;
}

double BounceWatch::see(const Vec3& v_V, const Vec3& force_V, double dt_s,
                        const ChatterParams& params) {
  const double force_n = force_V.norm();
  if (force_n > kTouch_n && !touching_) {
    touching_ = true;
    contact_s_ = 0;
    normal_V_ = force_V / force_n;
    speed_in_ = -v_V.dot(normal_V_);
    return 0;
  }
  if (!touching_) return 0;
  contact_s_ += dt_s;
  if (force_n > kTouch_n) return 0;
  touching_ = false;
  const double speed_out = v_V.dot(normal_V_);
  const bool short_and_fast =
      contact_s_ < params.longest_bounce_s && speed_in_ > params.least_speed_m_per_s;
  return short_and_fast && speed_out > kDyingDown * speed_in_ ? speed_out / speed_in_ : 0;
}

}  // namespace osteon
