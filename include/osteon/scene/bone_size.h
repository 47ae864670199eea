#pragma once

#include <string>

namespace osteon {

/// Longest side of the box around an adult's bone, m: of a long bone from a piece at a joint, as a
/// scan cuts it off, to the whole. Of a name that is not known: of any bone.
struct BoneSize {
  double least_m = 0.003, most_m = 0.7;
};
BoneSize usual_size(const std::string& bone_name);

/// Off the usual size by more than this factor, a bone has been read in the wrong unit.
inline constexpr double kWrongUnitFactor = 3;

/// "is 240 mm long, a capitate 18 to 32 mm"; empty while within the factor. `length_m` is the
/// longest side of its box.
std::string size_complaint(const std::string& bone_name, double length_m);

/// The unit that gives the bone its usual size: "m", "cm" or "mm", when read in one of
/// `metres_per_unit` it is `length_m` long; empty when none of them does.
std::string likely_unit(const std::string& bone_name, double length_m, double metres_per_unit);

}  // namespace osteon
