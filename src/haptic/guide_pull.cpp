#include "guide_pull.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/turn.h"

namespace osteon {

GuidePull pull_of(const ToolGuide& guide, const Pose& X_WB, const Vec3& bone_v_W,
                  const GuideHand& hand) {
  GuidePull out{true,        X_WB * guide.p_B, X_WB.rotate(guide.nhat_B),
                hand.X_WD.p, hand.X_WD.q,      Vec3::Zero()};
  const Vec3 off_W = hand.X_WD.p - out.line_W;
  const Vec3 across_W = off_W - off_W.dot(out.along_W) * out.along_W;
  const double e = across_W.norm(), k = hand.stiffness_n_per_m;
  const Vec3 aside_W = e > 0 ? Vec3(across_W / e) : Vec3(Vec3::Zero());
  double force = e / (1 / k + guide.give_m_per_n);
  if (force * guide.give_m_per_n > kMostBend_m) force = k * (e - kMostBend_m);
  const double bent = e - force / k;
  out.line_W += bent * aside_W;
  out.p_W -= guide.grip * (force / k) * aside_W;
  const Vec3 axis_W = hand.X_WD.q * Vec3::UnitZ();
  const Quat along = turn_between(axis_W, out.along_W) * hand.X_WD.q;
  out.q_W = hand.X_WD.q.slerp(guide.grip, along).normalized();
  // The damper may take the spring's part away, no more.
  const double slow = hand.damping_n_s_per_m * (hand.v_W - bone_v_W).dot(aside_W);
  out.force_W = -guide.grip * std::max(0.0, force + (e > 0 ? slow : 0.0)) * aside_W;
  const double over = off_W.dot(out.along_W) - guide.stop_m;
  if (!guide.pulls || !(over > 0)) return out;
  const double held = hand.damping_n_s_per_m * (hand.v_W - bone_v_W).dot(out.along_W);
  out.p_W -= guide.grip * over * out.along_W;
  out.force_W -= guide.grip * std::max(0.0, k * over + held) * out.along_W;
  return out;
}

PrimitiveContact hole_end(const ToolGuide& guide, const Pose& X_BT, double part_m, double tool_m,
                          double far_m) {
  PrimitiveContact out;
  const double top = guide.nhat_B.dot(guide.p_B) + guide.stop_m - tool_m;
  const double lowest = guide.nhat_B.dot(X_BT.p) - part_m;
  out.status = std::isfinite(lowest) ? LpStatus::kOptimal : LpStatus::kNumerical;
  out.nhat_AB_A = guide.nhat_B;
  out.gap = guide.stops ? std::min(lowest - top, far_m) : far_m;
  out.top_A = lowest - out.gap;
  out.p_A = X_BT.p - (part_m + out.gap) * guide.nhat_B;
  return out;
}

}  // namespace osteon
