#pragma once

#include "osteon/base/result.h"

namespace osteon {

inline constexpr double kPa_per_mmHg = 133.322;
inline constexpr double kM3_s_per_ml_min = 1e-6 / 60;

/// A joint that water flows through. Figures are D (our own defaults) but for those with a source.
struct FluidJoint {
  double room_m3 = 80e-6;           ///< of water in a knee
  double stretch_m3_per_pa = 4e-9;  ///< by how much the room grows with the pressure
  /// Flow for each pascal: in through the scope's sheath, out through the cannula, leaks at the
  /// portals.
  double inflow = 8 * kM3_s_per_ml_min / kPa_per_mmHg;
  double outflow = 4 * kM3_s_per_ml_min / kPa_per_mmHg;
  double leak = 0.3 * kM3_s_per_ml_min / kPa_per_mmHg;
  /// Of a shaver or sucker at full power: below the pressure of the air, and its flow a pascal.
  double suction_pa = 200 * kPa_per_mmHg;
  double suction = 1.5 * kM3_s_per_ml_min / kPa_per_mmHg;
  double vessel_pa = 80 * kPa_per_mmHg;  ///< where the joint's pressure stops all bleeding
  double blood_per_m = 6000;   ///< light that whole blood takes, each metre, over all colours
  double debris_per_m = 3000;  ///< the same of a slurry of cut tissue
};

/// A joint of a knee, and one of a wrist with its small room and thin sheath.
FluidJoint knee_fluid();
FluidJoint wrist_fluid();

/// What hands and pump do, and what bleeds.
struct FluidDrive {
  double pump_pa = 60 * kPa_per_mmHg;  ///< 70 to 120 mmHg are usual, 30 needed to see (K)
  double outlet_open = 0.5;            ///< 0 to 1
  double suction = 0;                  ///< power, 0 to 1
  double bleeding_m3_s = 0;            ///< of all sources, into a joint without pressure
  double debris_m3_s = 0;              ///< slurry that a tool makes
};

/// What is in the joint; a value, the same on every machine after the same steps.
struct FluidState {
  double pressure_pa = 0;  ///< above the air's
  double blood = 0;        ///< share of the volume, 0 to 1
  double debris = 0;
  double time_s = 0;
  double obscured_s = 0;  ///< of that time nothing could be seen
};

/// Flows of a moment, m3/s, none below zero.
struct FluidFlows {
  double in = 0, out = 0, sucked = 0, leaked = 0, bled = 0;
};
FluidFlows fluid_flows(const FluidJoint& joint, const FluidDrive& drive, double pressure_pa);

/// Fails on numbers that are not finite, are below zero, or are shares past 1.
Result<void> check_fluid(const FluidDrive& drive);

/// Goes on by `dt_s`. Which flows there are is that of the begin of the step; with these the
/// pressure and the mixture follow their closed forms, so that steps of any length agree while no
/// flow begins or ends.
FluidState step_fluid(const FluidJoint& joint, const FluidDrive& drive, const FluidState& state,
                      double dt_s);

/// Light that blood and debris take from a picture, each metre.
double light_taken_per_m(const FluidJoint& joint, const FluidState& state);
/// The share of light that is lost on the way to tissue 10 mm off and back: 0 clear, 1 nothing is
/// seen.
double turbidity(const FluidJoint& joint, const FluidState& state);
/// Turbidity over one half, or less than 30 mmHg, which do not hold the joint open.
bool is_obscured(const FluidJoint& joint, const FluidState& state);

/// The share of a cold lens that is fogged, after `dt_s` more: it warms and clears by itself,
/// faster while water is flushed over it.
double step_fog(double fog, bool flushed, double dt_s);

}  // namespace osteon
