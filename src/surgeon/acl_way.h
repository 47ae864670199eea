#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/scene/path.h"

namespace osteon {

/// A tool whose tip is at p and whose shaft leads back.
inline Pose held_by_shaft(const Vec3& p_W, const Vec3& back_W) {
  return {p_W, turn_between(Vec3::UnitZ(), back_W).normalized()};
}

/// A path as somebody thinks of it: there by then, stay.
class AclWay {
 public:
  /// `pace`: a share of the speeds that are asked for.
  AclWay(const std::string& instrument, double size_mm, const Pose& X, double pace) : pace_(pace) {
    path_.with_instruments = true;
    at_.X_WD = X;
    at_.instrument = instrument;
    at_.size_mm = size_mm;
    path_.samples.push_back(at_);
  }
  const Pose& pose() const { return at_.X_WD; }
  void go(const Pose& X, double seconds) {
    at_.X_WD = X;
    stay(std::max(seconds / pace_, 0.02));
  }
  void go_at(const Pose& X, double m_per_s) { go(X, (X.p - at_.X_WD.p).norm() / m_per_s); }
  void stay(double seconds) {
    if (!(seconds > 0)) return;
    at_.time_s += seconds;
    path_.samples.push_back(at_);
  }
  /// Another instrument in the hand, where it is.
  void take(const std::string& instrument, double size_mm) {
    at_.instrument = instrument;
    at_.size_mm = size_mm;
    stay(kTaken_s);
  }
  void power(double share) {
    at_.power = share;
    stay(kSaid_s);
  }
  void wait_until(double time_s) { stay(time_s - at_.time_s); }
  double now_s() const { return at_.time_s; }
  const ProbePath& path() const { return path_; }

 private:
  static constexpr double kTaken_s = 0.6, kSaid_s = 0.05;
  double pace_;
  ProbePath path_;
  PathSample at_;
};

/// The path of a hand that trembles at 8 to 11 Hz, as the other virtual surgeons do; a hand that
/// rests for long rests.
ProbePath trembling(const ProbePath& path, double tremor_m, std::uint64_t seed);

}  // namespace osteon
