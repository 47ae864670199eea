#include "input_checks.h"

namespace osteon {
namespace {

// Coordinates beyond the root of this are a broken reading: their squares must stay finite.
constexpr double kFarthest_m2 = 1e12;

}  // namespace

// What is not a number fails every comparison.
bool usable(const Pose& X) {
  const double size2 = X.q.squaredNorm();
  return X.p.squaredNorm() < kFarthest_m2 && size2 > 0.81 && size2 < 1.21;
}

bool usable(const ToolInput& input) {
  return usable(input.X_WD) && is_finite(input.v_W) && is_finite(input.w_W);
}

bool usable(const BoneSnapshot& bones, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const BoneMotion& bone = bones.bones[i];
    if (!usable(bone.X_WB) || !is_finite(bone.v_W) || !is_finite(bone.w_W)) return false;
  }
  return true;
}

}  // namespace osteon
