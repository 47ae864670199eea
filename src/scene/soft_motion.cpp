#include "osteon/scene/soft_motion.h"

namespace osteon {

Pose mean_motion(const BoneSnapshot& bones, std::span<const Pose> rest_X_WB,
                 std::span<const std::size_t> rides_on, const Vec3& center_W) {
  Vec3 moved_to_W = Vec3::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  double count = 0;
  for (const std::size_t bone : rides_on) {
    if (bone >= bones.count) continue;
    const Pose moved = bones.bones[bone].X_WB * rest_X_WB[bone].inverse();
    const Eigen::Vector4d q = moved.q.coeffs();
    turn += q.dot(turn) < 0 ? Eigen::Vector4d(-q) : q;
    moved_to_W += moved * center_W;
    count += 1;
  }
  if (count == 0 || turn.norm() < 1e-6) return {};
  const Quat q(turn / turn.norm());
  return {moved_to_W / count - q * center_W, q};
}

}  // namespace osteon
