#include "picker.h"

#include <limits>

#include "scene_painter.h"

namespace osteon {

Picker::Picker(const Case& the_case) {
  for (const Bone& bone : the_case.bones)
    bones_.emplace_back(bone.mesh.vertices, bone.mesh.triangles);
}

BoneId Picker::pick(const RenderSnapshot& snapshot, const ViewState& view, const Ray& ray) const {
  BoneId best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < bones_.size(); ++k) {
    if (!is_shown(snapshot, view, k)) continue;
    const Pose X_BW = snapshot.bones.bones[k].X_WB.inverse();
    const auto hit = bones_[k].closest(X_BW * ray.origin_W, X_BW.rotate(ray.dir_W), nearest);
    if (!hit) continue;
    nearest = hit->t;
    best.index = static_cast<std::uint32_t>(k);
  }
  return best;
}

}  // namespace osteon
