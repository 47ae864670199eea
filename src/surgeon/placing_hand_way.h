#pragma once

#include <string>
#include <vector>

#include "acl_way.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/scene/state.h"

namespace osteon {

inline constexpr double kPassCarry_m_per_s = 0.2, kPassNear_m_per_s = 0.03;
inline constexpr double kPassRound_m = 0.25;  ///< so far from the joint's middle tools are changed
inline constexpr double kPassTaken_s = 0.5, kPassJaw_s = 0.4, kPassBefore_m = 0.08;

/// Where a hand that goes round a joint would meet bone: unit vectors from the joint's middle to
/// places of bones that reach far out.
std::vector<Vec3> bones_far_out(const Case& the_case, const BoneSnapshot& bones,
                                const Vec3& middle_W);

/// Unit vectors from `from` to `to`, the last of them `to`, that stay as far as they can from all
/// of `bones`: straight over where that is far enough, else over the best of some detours.
std::vector<Vec3> way_round(const Vec3& from, const Vec3& to, const std::vector<Vec3>& bones);

/// One hand that changes instruments, far from the knee.
class PlacingHandWay {
 public:
  /// `bones`: see bones_far_out.
  PlacingHandWay(const std::string& instrument, const Pose& X, const Vec3& middle_W,
                 std::vector<Vec3> bones, double pace);
  void go(const Pose& X, double m_per_s);
  void stay(double seconds);
  /// Something else in the hand, where it is.
  void take(const std::string& instrument);
  void power(double share);
  double now_s() const { return at_.time_s; }
  void jaw(double open);
  /// Out, round the knee with another instrument, and in towards a place. On the way round its
  /// shaft points away from the knee, so that it sweeps no bone.
  void change(const std::string& instrument, const Vec3& to_W, const Vec3& back_W);
  const ProbePath& path() const { return path_; }

 private:
  double pace_;
  Vec3 middle_W_;
  std::vector<Vec3> bones_;
  ProbePath path_;
  PathSample at_;
};

}  // namespace osteon
