#include "osteon/scene/case.h"

#include <array>

namespace osteon {
namespace {

constexpr std::array<std::string_view, 4> kFeltNames{"pieces", "hull", "field", "covered"};

constexpr std::array<std::string_view, 7> kSoftKinds{"cartilage", "ligament", "tendon", "disc",
                                                     "meniscus",  "fat",      "skin"};

}  // namespace

std::span<const std::string_view> soft_kinds() { return kSoftKinds; }

std::string_view to_text(Felt felt) { return kFeltNames[static_cast<std::size_t>(felt)]; }

std::optional<Felt> felt_from_text(std::string_view text) {
  for (std::size_t i = 0; i < kFeltNames.size(); ++i)
    if (kFeltNames[i] == text) return static_cast<Felt>(i);
  return std::nullopt;
}

BoneId Case::find(std::string_view bone_name) const {
  for (std::uint32_t i = 0; i < bones.size(); ++i)
    if (bones[i].name == bone_name) return BoneId{i};
  return {};
}

Aabb Case::bounds_W() const {
  Aabb box;
  for (const Bone& bone : bones)
    if (!bone.beside)
      for (const Vec3& p_B : bone.mesh.vertices) box.include(bone.X_WB * p_B);
  return box;
}

}  // namespace osteon
