// Symbols: V volume of soft bone that is laid open, A area that bleeds, q its flow into a joint
// without pressure: q = ooze x A, of bone with the area of a ball of V, (36 pi V^2)^(1/3): no hole
// has less wall. The flow falls with the joint's pressure as joint_fluid.h says. Heat near a wound
// lets its area fall by an exponential. All figures are D, our own defaults: 0.05 ml/min from each
// cm2 of opened bone gives 45 ml in the first hour from both tunnels of a ligament (15 cm2), 0.3
// ml/min from each cm2 of a cut ligament as much in two hours from both ends of a cruciate one.
#include "osteon/physics/joint_water.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kFills_s = 120;      // until a joint that fills has come to rest
constexpr double kFillStep_s = 0.05;  // of it
constexpr double kBoneOoze_m_per_s = 8.3e-6;
constexpr double kSoftOoze_m_per_s = 5e-5;
// The chips and the blood of a drill that comes from outside leave along its flutes, all but this.
constexpr double kFluteShare = 0.2;
constexpr double kOneWound_m = 0.003;   // what is opened so near is one wound
constexpr double kMostOpen_m2 = 3e-4;   // of a wound
constexpr double kSealed_m2 = 1e-7;     // a smaller one bleeds no more
constexpr double kSealReach_m = 0.005;  // of the electrode's tip
constexpr double kSeals_s = 1;          // at full power, to 1/e

double wall_m2(double volume_m3) {
  return std::cbrt(36 * std::numbers::pi * volume_m3 * volume_m3);
}

bool is_share(double x) { return x >= 0 && x <= 1; }
bool is_size(double x) { return std::isfinite(x) && x >= 0; }

Vec3 place_of(const Wound& wound, const BoneSnapshot& bones) {
  return bones.bones[wound.bone.index].X_WB * wound.p_B;
}

}  // namespace

std::optional<FluidJoint> filled_joint(const Case& the_case) {
  if (the_case.find("radius").valid()) return wrist_fluid();
  if (the_case.find("femur").valid()) return knee_fluid();
  return std::nullopt;
}

void set_pump(double pump_pa, WaterState& state) {
  if (pump_pa >= 0 && pump_pa <= kMostPump_pa) state.pump_pa = pump_pa;
}

void set_outlet(double outlet_open, WaterState& state) {
  if (is_share(outlet_open)) state.outlet_open = outlet_open;
}

FluidDrive drive_of(const WaterState& state) {
  return {state.pump_pa, state.outlet_open, state.suction, state.bleeding_m3_s, state.debris_m3_s};
}

FluidState fluid_of(const WaterState& state) {
  FluidState out;
  out.pressure_pa = state.pressure_pa;
  out.blood = state.blood;
  out.debris = state.debris;
  return out;
}

double wound_flow(const FluidJoint& joint, const Wound& wound, double pressure_pa) {
  FluidDrive drive;
  drive.bleeding_m3_s = kSoftOoze_m_per_s * wound.open_m2;
  return fluid_flows(joint, drive, pressure_pa).bled;
}

JointWater::JointWater(const FluidJoint& joint, std::span<const std::shared_ptr<const Tool>> tray,
                       double step_s)
    : joint_(joint), step_s_(step_s) {
  for (const auto& tool : tray) uses_.push_back(tool->use);
}

WaterState JointWater::begin() const {
  FluidDrive drive;
  FluidState fluid;
  for (double t = 0; t < kFills_s; t += kFillStep_s)
    fluid = step_fluid(joint_, drive, fluid, kFillStep_s);
  WaterState state;
  state.on = true;
  state.pump_pa = drive.pump_pa;
  state.outlet_open = drive.outlet_open;
  state.pressure_pa = fluid.pressure_pa;
  return state;
}

WaterState JointWater::gone_back(const WaterState& kept, const WaterState& now) {
  WaterState out = kept;
  out.pump_pa = now.pump_pa;
  out.outlet_open = now.outlet_open;
  return out;
}

bool JointWater::fits(const WaterState& state) {
  for (const Wound& wound : state.wounds)
    if (wound.soft != kNoWound &&
        !(wound.bone.index < kMaxBones && is_finite(wound.p_B) && is_size(wound.open_m2)))
      return false;
  return is_size(state.pump_pa) && is_share(state.outlet_open) &&
         std::isfinite(state.pressure_pa) && is_share(state.blood) && is_share(state.debris) &&
         is_share(state.suction) && is_size(state.bleeding_m3_s) && is_size(state.debris_m3_s) &&
         is_size(state.removed_m3) && is_size(state.vascular_m3) && is_size(state.opened_m3);
}

// Where all places are taken the nearest wound grows, whichever part it is of.
void JointWater::open(const SoftOpening& opening, const BoneSnapshot& bones,
                      WaterState& state) const {
  if (!is_finite(opening.p_W) || !(opening.area_m2 > 0) || opening.bone.index >= bones.count)
    return;
  const Pose& X_WB = bones.bones[opening.bone.index].X_WB;
  if (!is_finite(X_WB)) return;
  Wound* free = nullptr;
  Wound* near = nullptr;
  double least_m = 0;
  for (Wound& wound : state.wounds) {
    if (wound.soft == kNoWound) {
      if (!free) free = &wound;
      continue;
    }
    const double far_m = (place_of(wound, bones) - opening.p_W).norm();
    const bool same = wound.soft == opening.soft && far_m < kOneWound_m;
    if (same) {
      wound.open_m2 = std::min(wound.open_m2 + opening.area_m2, kMostOpen_m2);
      return;
    }
    if (near && far_m >= least_m) continue;
    near = &wound;
    least_m = far_m;
  }
  const double area_m2 = std::min(opening.area_m2, kMostOpen_m2);
  if (free)
    *free = {opening.soft, opening.bone, X_WB.inverse() * opening.p_W, area_m2};
  else if (near)
    near->open_m2 = std::min(near->open_m2 + area_m2, kMostOpen_m2);
}

void JointWater::seal(const ToolState& tool, const BoneSnapshot& bones, WaterState& state) const {
  if (!is_finite(tool.X_WP)) return;
  const double left = std::exp(-std::min(tool.power, 1.0) * step_s_ / kSeals_s);
  for (Wound& wound : state.wounds) {
    if (wound.soft == kNoWound || wound.bone.index >= bones.count) continue;
    if (!((place_of(wound, bones) - tool.X_WP.p).norm() < kSealReach_m)) continue;
    wound.open_m2 *= left;
    if (wound.open_m2 < kSealed_m2) wound = {};
  }
}

void JointWater::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                      std::span<const SoftOpening> openings, const GoneBone* gone,
                      WaterState& state) const {
  bool outside = false, inside = false;
  state.suction = 0;
  for (const SoftOpening& opening : openings) open(opening, bones, state);
  for (const ToolState* tool : tools) {
    if (tool->tick == 0 || tool->instrument >= uses_.size() || !(tool->power > 0)) continue;
    const ToolUse& use = uses_[tool->instrument];
    if (use.sucks) state.suction = std::max(state.suction, std::min(tool->power, 1.0));
    if (use.burns) seal(*tool, bones, state);
    if (use.removes) (tool->portal == kNoPortal ? outside : inside) = true;
  }
  if (gone) {
    const double share = outside && !inside ? kFluteShare : 1;
    const double look_s = static_cast<double>(kLookEvery) * step_s_;
    state.debris_m3_s = share * std::max(0.0, gone->all_m3 - state.removed_m3) / look_s;
    state.opened_m3 += share * std::max(0.0, gone->vascular_m3 - state.vascular_m3);
    state.removed_m3 = gone->all_m3;
    state.vascular_m3 = gone->vascular_m3;
  }
  double wounds_m2 = 0;
  for (const Wound& wound : state.wounds)
    if (wound.soft != kNoWound) wounds_m2 += wound.open_m2;
  state.bleeding_m3_s =
      kBoneOoze_m_per_s * wall_m2(state.opened_m3) + kSoftOoze_m_per_s * wounds_m2;
  const FluidState next = step_fluid(joint_, drive_of(state), fluid_of(state), step_s_);
  state.pressure_pa = next.pressure_pa;
  state.blood = next.blood;
  state.debris = next.debris;
}

}  // namespace osteon
