#pragma once

#include <vector>

#include "osteon/render/renderer.h"
#include "surface/ray_bvh.h"

namespace osteon {

/// Finds the bone under a ray; a hierarchy for each bone, in Bone.
class Picker {
 public:
  explicit Picker(const Case& the_case);
  SurfacePoint pick(const RenderSnapshot& snapshot, const ViewState& view, const Ray& ray) const;
  void set_surface(std::size_t bone, const TriMesh& mesh_B);

 private:
  std::vector<RayBvh> bones_;
};

}  // namespace osteon
