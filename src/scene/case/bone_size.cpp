#include "osteon/scene/bone_size.h"

#include <string_view>

#include "numbers.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

struct SizeOfBone {
  std::string_view name;
  BoneSize size;
};

// Lengths and widths of adults' bones as White and Folkens, "The Human Bone Manual" (2005), give
// them, widened to the next few millimetres: a factor of three is what matters.
constexpr SizeOfBone kSizes[] = {
    {"radius", {0.030, 0.280}},       {"ulna", {0.030, 0.310}},
    {"scaphoid", {0.020, 0.034}},     {"lunate", {0.014, 0.026}},
    {"triquetrum", {0.013, 0.026}},   {"pisiform", {0.010, 0.020}},
    {"trapezium", {0.016, 0.030}},    {"trapezoid", {0.013, 0.026}},
    {"capitate", {0.018, 0.032}},     {"hamate", {0.018, 0.034}},
    {"metacarpal_1", {0.020, 0.060}}, {"metacarpal_2", {0.020, 0.085}},
    {"metacarpal_3", {0.020, 0.085}}, {"metacarpal_4", {0.020, 0.075}},
    {"metacarpal_5", {0.020, 0.070}}, {"femur", {0.060, 0.560}},
    {"tibia", {0.060, 0.460}},        {"fibula", {0.030, 0.440}},
    {"patella", {0.030, 0.060}},      {"lumbar_4", {0.060, 0.120}},
    {"lumbar_5", {0.060, 0.120}},
};

bool fits(const BoneSize& size, double length_m) {
  return length_m * kWrongUnitFactor >= size.least_m && length_m <= kWrongUnitFactor * size.most_m;
}

}  // namespace

BoneSize usual_size(const std::string& bone_name) {
  const std::string name = canonical_bone_name(bone_name);
  for (const SizeOfBone& known : kSizes)
    if (known.name == name) return known.size;
  return {};
}

std::string size_complaint(const std::string& bone_name, double length_m) {
  const BoneSize size = usual_size(bone_name);
  if (fits(size, length_m)) return {};
  return "is " + in_mm(length_m) + " long; usual lengths are " + in_mm(size.least_m) + " to " +
         in_mm(size.most_m) + ", so the unit may be wrong";
}

std::string likely_unit(const std::string& bone_name, double length_m, double metres_per_unit) {
  const BoneSize size = usual_size(bone_name);
  const double units = length_m / metres_per_unit;
  struct Unit {
    const char* name;
    double metres;
  };
  // The most usual first: two of them may fit a bone of a name that is not known.
  for (const Unit& unit : {Unit{"mm", 0.001}, Unit{"m", 1.0}, Unit{"cm", 0.01}})
    if (const double m = units * unit.metres; m >= size.least_m && m <= size.most_m)
      return unit.name;
  for (const Unit& unit : {Unit{"mm", 0.001}, Unit{"m", 1.0}, Unit{"cm", 0.01}})
    if (fits(size, units * unit.metres)) return unit.name;
  return {};
}

}  // namespace osteon
