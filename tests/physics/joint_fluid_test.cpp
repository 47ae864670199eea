// Water in a joint against closed forms: what flows comes to rest where in and out agree, and a
// mixture follows an exponential.
#include "osteon/physics/joint_fluid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace osteon {
namespace {

FluidState after(const FluidJoint& joint, const FluidDrive& drive, double s, double dt_s,
                 FluidState state = {}) {
  for (auto k = std::llround(s / dt_s); k > 0; --k) state = step_fluid(joint, drive, state, dt_s);
  return state;
}

FluidDrive still_water() {
  FluidDrive drive;
  drive.pump_pa = 0;
  drive.outlet_open = 0;
  return drive;
}

TEST(JointFluid, WhatIsNoNumberIsRefusedAndChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, -1.0, std::numeric_limits<double>::infinity()}) {
    FluidDrive drive;
    drive.pump_pa = bad;
    EXPECT_FALSE(check_fluid(drive));
    drive = {};
    drive.bleeding_m3_s = bad;
    EXPECT_FALSE(check_fluid(drive));
    drive = {};
    drive.outlet_open = bad;
    EXPECT_FALSE(check_fluid(drive));
    EXPECT_EQ(step_fluid(knee_fluid(), drive, {}, 0.1).time_s, 0);
  }
  EXPECT_EQ(step_fluid(knee_fluid(), {}, {}, nan).time_s, 0);
  FluidDrive open;
  open.outlet_open = 1.5;
  EXPECT_FALSE(check_fluid(open));
}

TEST(JointFluid, WithoutPumpAndBleedingNothingHappens) {
  const FluidState end = after(knee_fluid(), still_water(), 10, 0.1);
  EXPECT_EQ(end.pressure_pa, 0);
  EXPECT_EQ(end.blood, 0);
  EXPECT_DOUBLE_EQ(turbidity(knee_fluid(), end), 0);
  EXPECT_NEAR(end.time_s, 10, 1e-9);
}

TEST(JointFluid, PressureRestsWhereInAndOutAgreeAndGoesThereByAnExponential) {
  const FluidJoint joint = knee_fluid();
  FluidDrive drive;
  drive.outlet_open = 0.4;
  const double out = 0.4 * joint.outflow + joint.leak;
  const double rest = joint.inflow * drive.pump_pa / (joint.inflow + out);
  const double rate = (joint.inflow + out) / joint.stretch_m3_per_pa;
  const double after_2_s = rest * (1 - std::exp(-2 * rate));
  EXPECT_NEAR(after(joint, drive, 2, 2).pressure_pa, after_2_s, 1e-9 * rest);
  EXPECT_NEAR(after(joint, drive, 2, 0.01).pressure_pa, after_2_s, 1e-9 * rest);
  const FluidState end = after(joint, drive, 120, 0.1);
  EXPECT_NEAR(end.pressure_pa, rest, 1e-9 * rest);
  const FluidFlows flows = fluid_flows(joint, drive, end.pressure_pa);
  EXPECT_NEAR(flows.in, flows.out + flows.leaked, 1e-9 * flows.in);
}

TEST(JointFluid, BloodMixesAsInAWellStirredChamber) {
  const FluidJoint joint = knee_fluid();
  FluidDrive drive;
  FluidState state = after(joint, drive, 200, 0.1);  // the pressure has come to rest
  drive.bleeding_m3_s = 2 * kM3_s_per_ml_min;
  state = after(joint, drive, 200, 0.1, state);
  const FluidFlows flows = fluid_flows(joint, drive, state.pressure_pa);
  const double all = flows.in + flows.bled, rest = flows.bled / all;
  EXPECT_NEAR(flows.bled, drive.bleeding_m3_s * (1 - state.pressure_pa / joint.vessel_pa), 1e-18);
  state.blood = 0;
  EXPECT_NEAR(after(joint, drive, 15, 0.05, state).blood,
              rest * (1 - std::exp(-15 * all / joint.room_m3)), 1e-7 * rest);
  // Clear water washes it out.
  drive.bleeding_m3_s = 0;
  state = after(joint, drive, 200, 0.1, state);
  state.blood = 0.02;
  const double in = fluid_flows(joint, drive, state.pressure_pa).in;
  EXPECT_NEAR(after(joint, drive, 15, 0.05, state).blood, 0.02 * std::exp(-15 * in / joint.room_m3),
              1e-8);
}

TEST(JointFluid, AHighPressureStopsBleedingAndALowOneShowsNothing) {
  const FluidJoint joint = wrist_fluid();
  FluidDrive drive;
  drive.bleeding_m3_s = 1 * kM3_s_per_ml_min;
  EXPECT_EQ(fluid_flows(joint, drive, joint.vessel_pa).bled, 0);
  EXPECT_GT(fluid_flows(joint, drive, 0.5 * joint.vessel_pa).bled, 0);
  FluidState low;
  low.pressure_pa = 20 * kPa_per_mmHg;
  EXPECT_TRUE(is_obscured(joint, low));
  low.pressure_pa = 40 * kPa_per_mmHg;
  EXPECT_FALSE(is_obscured(joint, low));
  low.blood = 0.02;
  EXPECT_TRUE(is_obscured(joint, low));
  EXPECT_NEAR(turbidity(joint, low), 1 - std::exp(-0.020 * joint.blood_per_m * 0.02), 1e-12);
}

TEST(JointFluid, TimeWithoutSightIsCounted) {
  FluidDrive drive = still_water();
  EXPECT_NEAR(after(knee_fluid(), drive, 5, 0.1).obscured_s, 5, 1e-9);
  drive.pump_pa = 80 * kPa_per_mmHg;
  const FluidState end = after(knee_fluid(), drive, 60, 0.1);
  EXPECT_GT(end.obscured_s, 0) << "until the joint is filled";
  EXPECT_LT(end.obscured_s, 10);
}

TEST(JointFluid, ALensClearsByItselfAndSoonerWhenFlushed) {
  EXPECT_NEAR(step_fog(0.8, false, 20), 0.8 * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(step_fog(0.8, true, 2), 0.8 * std::exp(-1.1), 1e-12);
  EXPECT_EQ(step_fog(0.8, true, 0), 0.8);
}

}  // namespace
}  // namespace osteon
