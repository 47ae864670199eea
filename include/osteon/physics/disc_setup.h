#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/soft_solid_setup.h"
#include "osteon/scene/case.h"
#include "osteon/tissue/ligament_table.h"

namespace osteon {

/// Whether a name of --soft means the disc of a wrist: "tfcc", or a soft part of this kind.
bool names_disc(const Case& the_case, const std::string& name);

/// Makes solids of the disc that `row` names, one of each piece that it is in, the largest first.
/// Each is held where it meets bare bone (the rim of the radius, fovea and styloid of the ulna) and
/// lies where it meets the ulna's cartilage; fibres from bone to bone are under tension as far as
/// both ends hold. A piece that no bone holds is left out. Unlike a meniscus it is as stiff as its
/// modulus makes it, so that a tear is felt. `stiffness_n_per_m`: of the tissue table, limits how
/// soft a flap that was cut can be. Fails, and says what to do, where the case has no such part, or
/// where the part is open, lies between no two bones or reaches but one of them. `known`: as
/// make_soft_solids has it.
Result<std::vector<SoftSolid>> make_disc_solids(const Case& the_case, const DiscRow& row,
                                                double stiffness_n_per_m,
                                                FieldCache* known = nullptr);

}  // namespace osteon
