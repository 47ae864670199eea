#include "bone/placed_bones.h"

#include <utility>

#include "bone/grow.h"

namespace osteon {

PlacedBones::PlacedBones(const GeneratedAnatomy& grown, const GenerateOptions& options)
    : surfaces_W_(grown.bones.size()) {
  for (const GeneratedBone& bone : grown.bones) poses_WB_.push_back(bone.X_WB);
  run_tasks(options, surfaces_W_.size(), [&](std::size_t i) {
    TriMesh mesh_W = grown.bones[i].mesh;
    for (Vec3& v : mesh_W.vertices) v = poses_WB_[i] * v;
    surfaces_W_[i].emplace(std::move(mesh_W));
  });
}

std::optional<MeshDistance> PlacedBones::take(std::size_t bone, const Pose& X_WB) {
  if (bone >= surfaces_W_.size()) return std::nullopt;
  const Pose& own = poses_WB_[bone];
  if (own.p != X_WB.p || own.q.coeffs() != X_WB.q.coeffs()) return std::nullopt;
  return std::exchange(surfaces_W_[bone], std::nullopt);
}

}  // namespace osteon
