#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "gl/gl_objects.h"
#include "gl/gpu_mesh.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// A surface of which some cubes of a grid show something else now: where it is left out, and what
/// stands there. The shader leaves it out by the place of each pixel, so that neither the surface
/// nor its coarser levels are made anew.
class ChangedCubes {
 public:
  /// The surface as it was prepared: new vertices near an old one take its shade over. Cubes that
  /// were given stay.
  void set_base(const ShadedMesh& mesh);
  static constexpr std::size_t kSoft = static_cast<std::size_t>(-1);
  /// See Renderer::set_cubes. `bone` names the pattern of its colour; kSoft: it has none.
  void set(const CubeGrid& grid, std::span<const SurfaceCube> cubes, std::size_t bone);
  void clear();

  bool empty() const { return side_m_ == 0; }
  /// Cubes of this grid were given.
  bool is_on(const CubeGrid& grid) const {
    return !empty() && side_m_ == grid.side_m && lo_B_ == grid.lo_B && count_ == grid.count;
  }
  /// Holds all of what is drawn for one cube, in the frame of the surface.
  Aabb box_of(std::uint32_t cube) const;
  /// Tells a program whose shader knows of it (in use) what to leave out. The prepared surface goes
  /// on a little under the new ones, so that no crack shows; `clear`: it ends where they begin, for
  /// of what is looked through both would be seen there.
  void hide(const Program& program, bool clear = false) const;
  /// The new surfaces.
  void draw() const;
  void draw(const std::function<bool(const GpuMesh::Chunk&)>& wanted) const;

 private:
  bool fits(const CubeGrid& grid) const;
  void begin(const CubeGrid& grid);
  void sort_base(const CubeGrid& grid);
  ShadedMesh::Shade shade_near(const CubeGrid& grid, const Vec3& p_B) const;
  ShadedMesh shaded(const CubeGrid& grid, const SurfaceCube& cube, std::size_t bone) const;

  std::vector<std::array<float, 3>> base_;
  std::vector<ShadedMesh::Shade> base_shades_;
  std::vector<std::vector<std::uint32_t>> base_in_;  ///< of each cube: vertices of the base
  GlTexture mask_;                                   ///< of each cube: whether it has changed
  std::map<std::uint32_t, GpuMesh> surfaces_;
  Vec3 lo_B_ = Vec3::Zero();
  Pose X_GM_;
  double side_m_ = 0, overlap_m_ = 0;
  std::array<int, 3> count_{};
};

}  // namespace osteon
