#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "knee/knee_parts.h"
#include "osteon/tissue/held_joint.h"
#include "osteon/tissue/ligament_table.h"

namespace osteon {

/// Ends of a soft part that runs from the femur to the tibia or fibula, as in KneeParts. None: the
/// case has no such part.
std::optional<std::pair<Vec3, Vec3>> ends_of(const CaseDef& def, const KneeParts& parts,
                                             const std::string& name);

/// Fibres of a row of the table in a patient; none where its soft part is missing. Slack lengths
/// follow from the case's own bending.
std::vector<JointFibre> make_fibres(const CaseDef& def, const KneeParts& parts,
                                    const LigamentRow& row, double toe_strain);

/// Length of a fibre's way at a bend of the case's own.
double passive_length(const JointFibre& fibre, const PoseTrack& X_FT, double flexion_deg);

}  // namespace osteon
