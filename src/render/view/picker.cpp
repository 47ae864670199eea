#include "view/picker.h"

#include <limits>

#include "scene_painter.h"

namespace osteon {

Picker::Picker(const Case& the_case) {
  for (const Bone& bone : the_case.bones)
    bones_.emplace_back(bone.mesh.vertices, bone.mesh.triangles);
}

SurfacePoint Picker::pick(const RenderSnapshot& snapshot, const ViewState& view,
                          const Ray& ray) const {
  SurfacePoint best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < bones_.size(); ++k) {
    if (!is_shown(snapshot, view, k)) continue;
    const Pose X_BW = snapshot.bones.bones[k].X_WB.inverse();
    const auto hit = bones_[k].closest(X_BW * ray.origin_W, X_BW.rotate(ray.dir_W), nearest);
    if (!hit) continue;
    nearest = hit->t;
    best.bone.index = static_cast<std::uint32_t>(k);
    best.p_W = ray.origin_W + hit->t * ray.dir_W;
  }
  return best;
}

void Picker::set_surface(std::size_t bone, const TriMesh& mesh_B) {
  if (bone < bones_.size()) bones_[bone] = RayBvh(mesh_B.vertices, mesh_B.triangles);
}

}  // namespace osteon
