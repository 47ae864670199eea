#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "osteon/anatomy/variation.h"
#include "osteon/scene/build_case.h"

namespace osteon::checks {

/// A patient's knee, bent so far, that begins bent to `begin_deg` where that is given: bones,
/// tendons, skin, landmarks and joint.
inline Case grown_knee(std::uint64_t seed, double flexion_deg,
                       std::optional<double> begin_deg = {}) {
  const auto assets = std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy";
  GenerateOptions options;
  options.cell_m = 0.003;
  VariationRequest request;
  request.seed = seed;
  request.side = seed % 2 == 0 ? "right" : "left";
  request.set = {{"flexion_deg", flexion_deg}};
  auto grown =
      generate_varied(assets / "knee.toml", assets / "knee_variation.toml", request, options);
  if (!grown) throw std::runtime_error(grown.error().message());
  CaseDef def;
  def.name = "knee";
  def.side = grown->anatomy.side;
  for (GeneratedBone& from : grown->anatomy.bones) {
    BoneDef bone;
    bone.name = from.name;
    bone.X_WB = from.X_WB;
    bone.mesh = std::move(from.mesh);
    bone.felt = Felt::kHull;
    def.bones.push_back(std::move(bone));
  }
  for (GeneratedSoft& from : grown->anatomy.softs) {
    if (from.kind != "skin" && from.kind != "tendon") continue;
    SoftDef soft;
    soft.name = from.name;
    soft.tissue = from.tissue;
    soft.kind = from.kind;
    soft.mesh_W = std::move(from.mesh_W);
    soft.bones = from.bones;
    for (const GeneratedAttachment& end : from.attachments)
      soft.attachments.push_back({end.name, end.bone, end.p_W});
    def.softs.push_back(std::move(soft));
  }
  for (const GeneratedLandmark& from : grown->anatomy.landmarks)
    def.landmarks.push_back({from.name, from.p_W, from.inwards_W, from.bone});
  for (GeneratedJoint& from : grown->anatomy.joints) {
    JointDef joint{from.name, from.fixed, from.at_deg, {}};
    for (GeneratedJoint::Moved& moved : from.bones)
      joint.bones.push_back({moved.bone, std::move(moved.X_FB)});
    joint.begin_deg = begin_deg;
    def.joints.push_back(std::move(joint));
  }
  auto built = build_case(std::move(def));
  if (!built) throw std::runtime_error(built.error().message());
  return std::move(*built);
}

}  // namespace osteon::checks
