#include "osteon/physics/guide_line.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr double kRodFits_m = 0.0002;  // of diameters: so much too thick still goes through
constexpr double kOffPin_m = 0.001;    // over the bone in which a pin holds
constexpr double kInSleeve_m = 0.004;  // over the place that a sleeve aims at

}  // namespace

bool rod_leads(const GuideRod& rod, const CarvingTool& with) {
  if (rod.kind == GuideRod::Kind::kPin) return with.pilot_m + kRodFits_m >= 2 * rod.radius_m;
  return rod.kind == GuideRod::Kind::kSleeve && with.cutter.size_m <= 2 * rod.radius_m + kRodFits_m;
}

std::optional<Pose> held_on_rod(const GuideRods& rods, std::span<const BoneMotion> bones,
                                const CarvingTool& with, const Pose& like_W) {
  std::optional<Pose> held;
  double least_m = 0;
  for (const GuideRod& rod : rods) {
    if (!rod_leads(rod, with) || rod.bone >= bones.size()) continue;
    const Pose X_WR = bones[rod.bone].X_WB * rod.X_BR;
    const Vec3 out = X_WR.q * Vec3::UnitZ(), off = like_W.p - X_WR.p;
    const double along = off.dot(out), across = (off - along * out).norm();
    if (held && !(across < least_m)) continue;
    const bool pin = rod.kind == GuideRod::Kind::kPin;
    const double lowest = std::min(pin ? rod.in_bone_m + kOffPin_m : kInSleeve_m, rod.length_m);
    const Quat turn = Quat::FromTwoVectors(like_W.q * Vec3::UnitZ(), out);
    held = Pose{X_WR.p + std::clamp(along, lowest, rod.length_m) * out,
                (turn * like_W.q).normalized()};
    least_m = across;
  }
  return held;
}

}  // namespace osteon
