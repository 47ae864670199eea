#pragma once

#include <string>
#include <vector>

#include "acl_way.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/scene/state.h"

namespace osteon {

inline constexpr double kHandCarry_m_per_s = 0.2, kHandNear_m_per_s = 0.03;
inline constexpr double kHandTaken_s = 0.5;  ///< until a line has taken on what is pushed along it
inline constexpr double kHandBefore_m = 0.08;  ///< a mouth

/// One hand that changes instruments: what it does, one thing after the other.
class HandWay {
 public:
  /// `pace`: a share of the speeds that are asked for.
  HandWay(const std::string& instrument, const Pose& X, double pace);
  void go(const Pose& X, double m_per_s);
  void stay(double seconds);
  /// Something else in the hand, where it is; no `size_mm`: in the size of its name, or the usual.
  void take(const std::string& instrument, double size_mm = 0);
  void power(double share);
  void jaw(double open);
  double now_s() const { return at_.time_s; }
  const Pose& pose() const { return at_.X_WD; }
  const ProbePath& path() const { return path_; }

 private:
  double pace_;
  ProbePath path_;
  PathSample at_;
};

/// A joint and what of its bones is in the way of a hand that goes round it.
struct RoundJoint {
  Vec3 middle_W = Vec3::Zero();
  std::vector<Vec3> bones;  ///< unit vectors from there to places of bones that reach far out
};
RoundJoint round_joint(const Case& the_case, const BoneSnapshot& bones, const Vec3& middle_W);

/// Tools are changed so far from the joint's middle.
inline constexpr double kRound_m = 0.25;

/// Unit vectors from `from` to `to`, the last of them `to`, that stay as far as they can from all
/// of `bones`: straight over where that is far enough, else over the best of some detours.
std::vector<Vec3> way_round(const Vec3& from, const Vec3& to, const std::vector<Vec3>& bones);

/// Out, round the joint with another instrument, and in towards a place. On the way round its shaft
/// points away from the joint, so that it sweeps no bone.
void change_round(HandWay& way, const RoundJoint& joint, const std::string& instrument,
                  const Vec3& to_W, const Vec3& back_W);

}  // namespace osteon
