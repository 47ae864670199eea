#include "osteon/physics/joint_fluid.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kSeen_m = 0.010;
constexpr double kObscured = 0.5;
constexpr double kHeldOpen_pa = 30 * kPa_per_mmHg;
constexpr double kWarms_s = 20, kFlushes_s = 2;

bool is_amount(double value) { return std::isfinite(value) && value >= 0; }
bool is_part(double value) { return is_amount(value) && value <= 1; }

/// From `now` towards `aim` at a rate: exact for a constant aim.
double towards(double now, double aim, double rate_per_s, double dt_s) {
  return aim + (now - aim) * std::exp(-rate_per_s * dt_s);
}

}  // namespace

FluidJoint knee_fluid() { return {}; }

FluidJoint wrist_fluid() {
  FluidJoint joint;
  joint.room_m3 = 6e-6;
  joint.stretch_m3_per_pa = 3e-10;
  joint.inflow = 2 * kM3_s_per_ml_min / kPa_per_mmHg;
  joint.outflow = 1 * kM3_s_per_ml_min / kPa_per_mmHg;
  joint.leak = 0.1 * kM3_s_per_ml_min / kPa_per_mmHg;
  return joint;
}

FluidFlows fluid_flows(const FluidJoint& joint, const FluidDrive& drive, double pressure_pa) {
  FluidFlows flows;
  flows.in = joint.inflow * std::max(0.0, drive.pump_pa - pressure_pa);
  flows.out = joint.outflow * drive.outlet_open * std::max(0.0, pressure_pa);
  flows.leaked = joint.leak * std::max(0.0, pressure_pa);
  flows.sucked =
      joint.suction * drive.suction * std::max(0.0, joint.suction_pa * drive.suction + pressure_pa);
  flows.bled = drive.bleeding_m3_s * std::max(0.0, 1 - pressure_pa / joint.vessel_pa);
  return flows;
}

Result<void> check_fluid(const FluidDrive& drive) {
  if (!is_amount(drive.pump_pa)) return fail("is not a pressure", "the pump");
  if (!is_part(drive.outlet_open)) return fail("is not 0 to 1", "the outlet");
  if (!is_part(drive.suction)) return fail("is not 0 to 1", "the suction");
  if (!is_amount(drive.bleeding_m3_s)) return fail("is not a flow", "the bleeding");
  if (!is_amount(drive.debris_m3_s)) return fail("is not a flow", "the debris");
  return {};
}

// Symbols: p pressure, E the room's stretch, G the sum of what the flows change by with p, Q their
// sum at p = 0; V the room, c a share of its water, q what comes in of it, s all that comes in.
// E dp/dt = Q - G p and, in a room that is well mixed, V dc/dt = q - s c: each goes to its end, Q/G
// and q/s, by an exponential. The mixture takes the flows of the step's end, where its pressure has
// come to rest long before.
FluidState step_fluid(const FluidJoint& joint, const FluidDrive& drive, const FluidState& state,
                      double dt_s) {
  if (!(dt_s > 0) || !std::isfinite(dt_s) || !check_fluid(drive)) return state;
  FluidState next = state;
  const double p = state.pressure_pa;
  const FluidFlows now = fluid_flows(joint, drive, p);
  double slope = 0;
  if (now.in > 0) slope += joint.inflow;
  if (p >= 0) slope += joint.outflow * drive.outlet_open + joint.leak;
  if (now.sucked > 0) slope += joint.suction * drive.suction;
  if (now.bled > 0) slope += drive.bleeding_m3_s / joint.vessel_pa;
  const double net = now.in + now.bled + drive.debris_m3_s - now.out - now.leaked - now.sucked;
  if (slope > 0)
    next.pressure_pa = towards(p, p + net / slope, slope / joint.stretch_m3_per_pa, dt_s);
  else
    next.pressure_pa = p + net / joint.stretch_m3_per_pa * dt_s;
  const FluidFlows then = fluid_flows(joint, drive, next.pressure_pa);
  const double all = then.in + then.bled + drive.debris_m3_s;
  if (all > 0) {
    const double rate = all / joint.room_m3;
    next.blood = towards(state.blood, then.bled / all, rate, dt_s);
    next.debris = towards(state.debris, drive.debris_m3_s / all, rate, dt_s);
  }
  next.time_s += dt_s;
  if (is_obscured(joint, next)) next.obscured_s += dt_s;
  return next;
}

double light_taken_per_m(const FluidJoint& joint, const FluidState& state) {
  return joint.blood_per_m * state.blood + joint.debris_per_m * state.debris;
}

double turbidity(const FluidJoint& joint, const FluidState& state) {
  return -std::expm1(-2 * kSeen_m * light_taken_per_m(joint, state));
}

bool is_obscured(const FluidJoint& joint, const FluidState& state) {
  return state.pressure_pa < kHeldOpen_pa || turbidity(joint, state) > kObscured;
}

double step_fog(double fog, bool flushed, double dt_s) {
  if (!(dt_s > 0) || !std::isfinite(dt_s)) return fog;
  return towards(fog, 0, 1 / kWarms_s + (flushed ? 1 / kFlushes_s : 0), dt_s);
}

}  // namespace osteon
