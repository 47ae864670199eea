#include "osteon/scene/bone_names.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

struct KnownBone {
  std::string_view name;
  int fma_id;                             ///< Foundational Model of Anatomy
  std::array<std::string_view, 4> files;  ///< other usual file names, lower case
};

constexpr KnownBone kKnown[] = {
    {"radius", 23463, {}},
    {"ulna", 23466, {}},
    {"scaphoid", 23709, {"navicular_hand", "os_scaphoideum"}},
    {"lunate", 23712, {"os_lunatum"}},
    {"triquetrum", 23715, {"triquetral", "os_triquetrum"}},
    {"pisiform", 23718, {"os_pisiforme"}},
    {"trapezium", 23721, {"os_trapezium"}},
    {"trapezoid", 23724, {"os_trapezoideum"}},
    {"capitate", 23727, {"os_capitatum"}},
    {"hamate", 23730, {"os_hamatum"}},
    {"metacarpal_1", 23899, {"1mc", "mc1", "metacarpal1", "first_metacarpal"}},
    {"metacarpal_2", 23900, {"2mc", "mc2", "metacarpal2", "second_metacarpal"}},
    {"metacarpal_3", 23901, {"3mc", "mc3", "metacarpal3", "third_metacarpal"}},
    {"metacarpal_4", 23902, {"4mc", "mc4", "metacarpal4", "fourth_metacarpal"}},
    {"metacarpal_5", 23903, {"5mc", "mc5", "metacarpal5", "fifth_metacarpal"}},
    {"femur", 9611, {}},
    {"tibia", 24476, {}},
    {"fibula", 24479, {}},
    {"patella", 24485, {}},
    {"lumbar_4", 13075, {"l4", "lumbar4", "vertebra_l4"}},
    {"lumbar_5", 13076, {"l5", "lumbar5", "vertebra_l5"}},
};

// Lower case, with underscores for blanks and hyphens.
std::string normal_form(std::string_view name) {
  std::string out(name);
  std::transform(out.begin(), out.end(), out.begin(), [](char c) {
    if (c >= 'A' && c <= 'Z') return static_cast<char>(c - 'A' + 'a');
    return c == ' ' || c == '-' ? '_' : c;
  });
  return out;
}

const KnownBone* find_known(std::string_view name) {
  const std::string wanted = normal_form(name);
  if (wanted.empty()) return nullptr;
  for (const KnownBone& bone : kKnown)
    if (bone.name == wanted ||
        std::find(bone.files.begin(), bone.files.end(), wanted) != bone.files.end())
      return &bone;
  return nullptr;
}

}  // namespace

int fma_id_of(const std::string& bone_name) {
  const KnownBone* bone = find_known(bone_name);
  return bone ? bone->fma_id : 0;
}

std::vector<std::string> known_bone_names() {
  std::vector<std::string> names;
  for (const KnownBone& bone : kKnown) names.emplace_back(bone.name);
  return names;
}

std::string canonical_bone_name(const std::string& file_stem) {
  const KnownBone* bone = find_known(file_stem);
  return bone ? std::string(bone->name) : file_stem;
}

}  // namespace osteon
