#pragma once

#include <filesystem>

#include "osteon/base/result.h"
#include "osteon/physics/knee_laxity.h"

namespace osteon {

/// A right knee as published with fibres that were validated (Lenhart and others 2015, of OpenSim
/// JAM): a folder with `knee_ligaments.csv` (name, bone and place of both ends in mm, stiffness,
/// slack length) and `knee_cartilage/` (binary STL, metres). Its axes are x forwards, y up, z to
/// the right. Fibres to the patella are left out, and those of the names in `without`, which are
/// named as in the ligament table. The set has no cartilage of the femur: there it is reckoned as
/// thick as leaves both plateaus just touching when stretched. Cartilage is as the table's.
Result<KneeModel> load_reference_knee(const std::filesystem::path& folder,
                                      const LigamentTable& table,
                                      const std::vector<std::string>& without);

}  // namespace osteon
