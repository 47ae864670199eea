#pragma once

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// What a tool of a round section meets on its way through a sheet.
struct PierceLaw {
  double peak_n = 0;         ///< force at which the sheet breaks under the tip; 0: a cut lets it in
  double grip_n = 0;         ///< most that the hole's rim holds the shaft with, either way
  double resist_n = 0;       ///< of the fat before the tip, while it goes in
  double stick_n_per_m = 0;  ///< of the rim before the shaft slips
  double hole_m = 0;         ///< radius of the hole at rest
};
/// `cut_m`: length of a slit in which the tip is set, 0: none. `stiffness_n_per_m`: of the sheet to
/// a slight push of this tool.
PierceLaw pierce_law(const SheetMaterial& material, double radius_m, double cut_m,
                     double stiffness_n_per_m);

/// A tool that presses, breaks through and slides: a value.
struct PierceState {
  bool through = false;
  double force_n = 0;   ///< on the tool, outwards
  double excess_n = 0;  ///< what is left of the peak
  double depth_m = 0;   ///< of the tip under the sheet at rest
};
/// The tip is at `depth_m` after a step. `elastic_n`: force of the whole sheet pressed so deep.
/// True in the step in which it breaks through. Not felt after that: the tip out of the hole.
bool pierce_step(PierceState& state, const PierceLaw& law, double depth_m, double elastic_n,
                 double step_s);

}  // namespace osteon
