#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/soft_solid_setup.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Whether a name of --soft means what torn ligaments have left: "stumps".
bool names_stumps(const std::string& name);

/// How a stump is felt: that of a ligament that pulls on nothing.
struct StumpStiffness {
  double stiffness_n_per_m = 0;  ///< of the ligament's surface
  double cutting_n = 0;          ///< force of a blade that cuts the ligament
};

/// Makes solids of the stumps of the case's torn ligaments: each hangs on its bone at its
/// footprint, and what lies more than 1.5 mm above the bone is to be cleared, so that the footprint
/// stays to be seen. Torn fibres carry nothing: half of the ligament's stiffness and cutting force
/// is left (an assumption of ours). Fails, and says what to do, where no ligament of the case is
/// torn through. `known`: as make_soft_solids has it.
Result<std::vector<SoftSolid>> make_stumps(const Case& the_case, const StumpStiffness& of,
                                           FieldCache* known = nullptr);

}  // namespace osteon
