#pragma once

#include <algorithm>
#include <string>

#include "acl_way.h"
#include "osteon/scene/path.h"

namespace osteon {

inline constexpr double kPassCarry_m_per_s = 0.2, kPassNear_m_per_s = 0.03;
inline constexpr double kPassRound_m = 0.25;  ///< so far from the joint's middle tools are changed
inline constexpr double kPassTaken_s = 0.5, kPassJaw_s = 0.4, kPassBefore_m = 0.08;

/// One hand that changes instruments, far from the knee.
class PlacingHandWay {
 public:
  PlacingHandWay(const std::string& instrument, const Pose& X, const Vec3& middle_W, double pace)
      : pace_(pace), middle_W_(middle_W) {
    path_.with_instruments = true;
    at_.X_WD = X;
    at_.instrument = instrument;
    path_.samples.push_back(at_);
  }
  void go(const Pose& X, double m_per_s) {
    const double seconds = (X.p - at_.X_WD.p).norm() / (m_per_s * pace_);
    at_.X_WD = X;
    stay(std::max(seconds, 0.05));
  }
  void stay(double seconds) {
    at_.time_s += seconds;
    path_.samples.push_back(at_);
  }
  /// Something else in the hand, where it is.
  void take(const std::string& instrument) {
    stay(0.2);
    at_.instrument = instrument;
    at_.jaw = at_.power = 0;
    path_.samples.back() = at_;
    stay(0.3);
  }
  void power(double share) {
    stay(0.02);
    at_.power = share;
    path_.samples.back().power = share;
    stay(0.2);
  }
  double now_s() const { return at_.time_s; }
  void jaw(double open) {
    stay(0.02);
    at_.jaw = open;
    path_.samples.back().jaw = open;
    stay(kPassJaw_s);
  }
  // Out, round the knee with another instrument, and in towards a place.
  void change(const std::string& instrument, const Vec3& to_W, const Vec3& back_W) {
    const Vec3 from = (at_.X_WD.p - middle_W_).normalized();
    const Vec3 to = (to_W - middle_W_).normalized();
    go({middle_W_ + kPassRound_m * from, at_.X_WD.q}, kPassCarry_m_per_s);
    take(instrument);
    constexpr int kSteps = 6;
    for (int i = 1; i <= kSteps; ++i) {
      const double share = static_cast<double>(i) / kSteps;
      const Vec3 way = ((1 - share) * from + share * to).normalized();
      go(held_by_shaft(middle_W_ + kPassRound_m * way, back_W), kPassCarry_m_per_s);
    }
    go(held_by_shaft(to_W, back_W), kPassCarry_m_per_s);
  }
  const ProbePath& path() const { return path_; }

 private:
  double pace_;
  Vec3 middle_W_;
  ProbePath path_;
  PathSample at_;
};

}  // namespace osteon
