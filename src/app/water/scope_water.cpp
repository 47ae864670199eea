#include "water/scope_water.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kLeap_s = 1;
// A plume is a cloud that reaches so far beyond its wound, and that the water carries off so fast
// (D).
constexpr double kBeyond_m = 0.0025, kCarried_m_per_s = 0.005;
constexpr double kMostBlood = 0.2;  // share of the water in a plume's middle

}  // namespace

ScopeWater scope_water(const FluidJoint& joint, const BoneSnapshot& bones,
                       const FluidState* fluid) {
  ScopeWater out;
  const WaterState& water = bones.water;
  if (!water.on) return out;
  const FluidState mixture = fluid ? *fluid : fluid_of(water);
  out.taken_per_m = light_taken_per_m(joint, mixture);
  const double blood_per_m = joint.blood_per_m * mixture.blood;
  out.blood = out.taken_per_m > 0 ? blood_per_m / out.taken_per_m : 0;
  for (const Wound& wound : water.wounds) {
    if (wound.soft == kNoWound || wound.bone.index >= bones.count ||
        out.plume_count == out.plumes.size())
      continue;
    const double flow_m3_s = wound_flow(joint, wound, mixture.pressure_pa);
    if (!(flow_m3_s > 0)) continue;
    // A wound is the two ends of a part that was cut, each a disc.
    const double radius_m = kBeyond_m + std::sqrt(0.5 * wound.open_m2 / std::numbers::pi);
    const double across_m2 = std::numbers::pi * radius_m * radius_m;
    const double share = std::min(flow_m3_s / (across_m2 * kCarried_m_per_s), kMostBlood);
    const Pose& X_WB = bones.bones[wound.bone.index].X_WB;
    out.plumes[out.plume_count++] = {X_WB * wound.p_B, radius_m, joint.blood_per_m * share};
  }
  return out;
}

OtherPump::OtherPump(const FluidJoint& joint, const WaterSettings& settings)
    : joint_(joint), settings_(settings) {}

void OtherPump::go_to(double time_s, const WaterState& session) {
  if (!std::isfinite(time_s)) return;
  const double dt_s = time_s_ ? time_s - *time_s_ : -1;
  if (dt_s < 0 || dt_s > kLeap_s) {
    state_ = fluid_of(session);
  } else {
    FluidDrive drive = drive_of(session);
    drive.pump_pa = settings_.pump_pa;
    drive.outlet_open = settings_.outlet_open;
    state_ = step_fluid(joint_, drive, state_, dt_s);
  }
  time_s_ = time_s;
}

}  // namespace osteon
