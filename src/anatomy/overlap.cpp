#include "overlap.h"

#include <algorithm>

#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

TriMesh in_world(const GeneratedBone& bone) {
  TriMesh mesh = bone.mesh;
  for (Vec3& v : mesh.vertices) v = bone.X_WB * v;
  return mesh;
}

Aabb box_of(const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  return box;
}

double depth_in(const TriMesh& points, const MeshDistance& other, const Aabb& box) {
  double depth = 0;
  for (const Vec3& p : points.vertices)
    if (box.overlaps({p, p})) depth = std::max(depth, -other.closest(p).signed_distance);
  return depth;
}

}  // namespace

Overlap deepest_overlap(const GeneratedAnatomy& anatomy) {
  std::vector<TriMesh> meshes;
  std::vector<Aabb> boxes;
  for (const GeneratedBone& bone : anatomy.bones) {
    meshes.push_back(in_world(bone));
    boxes.push_back(box_of(meshes.back()));
  }
  Overlap deepest;
  for (std::size_t j = 0; j < meshes.size(); ++j) {
    const MeshDistance other(meshes[j]);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (i == j || !boxes[i].overlaps(boxes[j])) continue;
      const double depth = depth_in(meshes[i], other, boxes[j]);
      if (depth > deepest.depth) deepest = {anatomy.bones[i].name, anatomy.bones[j].name, depth};
    }
  }
  return deepest;
}

}  // namespace osteon
