#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/physics/soft_solid_setup.h"
#include "osteon/tissue/pressed_solid.h"

namespace osteon {

/// The surface of a soft solid that is cut, for pictures, closed and manifold: walls of cuts are
/// part of it. What a new cut does not come near keeps its surface, so that a stroke costs little.
class CutShape {
 public:
  /// `solid` must outlive this.
  explicit CutShape(const SoftSolid& solid) : solid_(&solid) {}

  /// False: they are not cuts of this solid; nothing has changed.
  bool show(const CarveState& cuts);
  const TriMesh& mesh_B() const { return mesh_B_; }
  const std::vector<SolidPatch>& patches() const { return patches_; }  ///< of each vertex

 private:
  bool take(const CarveState& cuts);
  void find_patches(std::vector<std::uint64_t> keys, TriMesh mesh_B);

  const SoftSolid* solid_;
  std::optional<CarvedField> field_;
  std::optional<CarvedSurface> surface_;
  TriMesh mesh_B_;
  std::vector<std::uint64_t> keys_;  ///< of its vertices, rising
  std::vector<SolidPatch> patches_;
};

}  // namespace osteon
