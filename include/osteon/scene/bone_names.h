#pragma once

#include <string>
#include <vector>

namespace osteon {

/// Osteon's own names of the bones that it knows: those with a number in the Foundational Model of
/// Anatomy (fma_id_of).
std::vector<std::string> known_bone_names();

}  // namespace osteon
