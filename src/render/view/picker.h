#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
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
  /// See Renderer::set_cubes; of bones alone.
  void set_cubes(std::size_t bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes);
  void clear_cubes();

 private:
  /// What of a bone's surface lies in one cube now.
  struct Cube {
    Aabb box;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
  };
  struct Changed {
    CubeGrid grid;
    std::vector<std::uint8_t> is;  ///< of each cube
    std::map<std::uint32_t, Cube> cubes;
    bool at(const Vec3& p_G) const;
  };
  bool left_out(const Changed& changed, const Vec3& p_B) const;
  std::optional<double> hit_base(std::size_t bone, const Vec3& origin, const Vec3& dir,
                                 double most) const;

  std::vector<RayBvh> bones_;
  std::vector<Changed> changed_;  ///< of each bone; no cubes: nothing
};

}  // namespace osteon
