#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"

namespace osteon {

class LightByCell;

/// The light of a surface that was cut, by its vertices.
struct CutLight {
  std::shared_ptr<const LightByCell> near;  ///< of the surface at rest
  std::vector<Vec3> rest_vertices;          ///< that `near` was made of
  std::vector<Triangle> triangles;
  std::vector<ShadedMesh::Shade> of_vertices;
  bool closed = false;
};

/// What prepare_case found of a soft surface at rest, by its points.
struct RestLight {
  RestLight() = default;
  RestLight(std::vector<ShadedMesh::Shade> of_points, std::vector<ShadedMesh::Root> in_bone = {})
      : shades(std::move(of_points)), roots(std::move(in_bone)) {}
  std::vector<ShadedMesh::Shade> shades;
  std::vector<ShadedMesh::Root> roots;
  CutLight cut;  ///< as cut_light last found it
};

/// A soft surface that has given way, with the light that was worked out for it at rest: each
/// vertex takes its own along, and stays drawn into bone. `baked`: what prepare_case found of
/// `rest`. Empty where `moved` has not as many vertices as `rest`, or the light is of another
/// surface.
ShadedMesh moved_light(const TriMesh& rest, const RestLight& baked, const TriMesh& moved);
/// In a wound, by how deep it lies: 129 at its edge to 255 at kDeepestWound_m; 128 is outside.
inline constexpr double kDeepestWound_m = 0.012;
std::uint8_t wound_depth(double depth_m);

/// A soft surface that was cut open: its first vertices are those of `rest` and keep their light;
/// others take it from near them, and are the darker the deeper they lie in a cut. The fold of skin
/// stays. `depth_m`: of each vertex of `opened`, 0 outside of cuts; in cuts `felt` says it
/// (wound_depth).
ShadedMesh opened_light(const TriMesh& rest, const RestLight& light, const TriMesh& opened,
                        std::span<const float> depth_m);

}  // namespace osteon
