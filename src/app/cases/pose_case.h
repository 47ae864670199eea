#pragma once

#include <functional>
#include <string>

#include "cases/make_patient.h"
#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// The order that grows the case of this recipe again.
PatientOrder order_of(const CaseRecipe& recipe);
CaseRecipe recipe_of(const PatientOrder& order);

/// Bends a joint of a case: its bones are put as the joint says, soft parts, landmarks and joints
/// are those of the same patient grown in that pose. What else the case says of its bones stays.
/// Fails, with what there is, when the case has no such joint or `degrees` is beyond its range, and
/// when it cannot be grown again: it has no recipe, or its bones were changed since. `soft_parts`
/// false: they are left out. `progress` may throw to stop.
Result<CaseDef> bend_case(CaseDef def, const std::string& joint, double degrees, bool soft_parts,
                          const std::function<void(double)>& progress = {});

}  // namespace osteon
