#pragma once

#include <array>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/thrust.h"

namespace osteon {

/// A layer of bone in the drill's way, from the surface on.
struct DrillLayer {
  std::string material;  ///< of the drill table
  double thickness_m = 0;
};

/// An emulated hand: it holds a thrust while it meets bone. When the bone gives way its muscles act
/// as a spring and a damper for longer than the plunge takes.
struct DrillHand {
  double thrust_n = 40;
  double drop_n = 0;                ///< less in the last layer: experts take off about 5.5 N
  double mass_kg = 1.5;             ///< hand and drill
  double stiffness_n_per_m = 6500;  ///< with it 34.5 N plunge by the 5.3 mm of experts
  double damping_ratio = 0.8;
};

struct DrillSample {
  double time_s = 0;
  double tip_m = 0;      ///< from the surface
  double removed_m = 0;  ///< depth that the drill has cleared
  double resistance_n = 0;
  double torque_nm = 0;
  double feed_m_per_rev = 0;
  double hottest_c = 0;  ///< 0.2 mm beside the hole's wall
};

struct DrillTrial {
  std::vector<DrillSample> samples;
  bool through = false;
  double plunge_m = 0;   ///< of the tip beyond the last layer
  double hottest_c = 0;  ///< ever, 0.2 mm beside the wall
  std::array<double, 2> necrosis_m3{};
};

struct DrillTrialOptions {
  double longest_s = 300;
  double sample_s = 0.05;
  bool heat = false;
  bool water = false;
};

/// Drills through layers with an emulated hand at 1 kHz. Fails on a material that the table lacks,
/// no layer, and numbers out of range.
Result<DrillTrial> run_drill_trial(const DrillTable& table, const std::vector<DrillLayer>& layers,
                                   const DrillTool& tool, const DrillHand& hand,
                                   const DrillTrialOptions& options = {});

}  // namespace osteon
