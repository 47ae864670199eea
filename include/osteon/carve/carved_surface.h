#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/carved_field.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Surface of one block, in Bone: complete in itself. Vertices on its rim stand, bit by bit the
/// same, in the patches of the blocks beside it too, under the same keys.
struct SurfacePatch {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;
  std::vector<std::uint64_t> keys;  ///< of vertices: which cell of the grid, which of its sheets
  std::vector<Triangle> triangles;
  void clear();
};

/// What is left of the bone, as a surface by blocks; a block whose field did not change keeps its
/// patch. Dual marching cubes (Nielson 2004), ambiguous faces as in isosurface.h, so that no edge
/// has more than two triangles; a vertex lies where the planes of its cell's crossings meet best
/// (dual contouring; Ju, Losasso, Schaefer, Warren 2002), which keeps rims sharp.
class CarvedSurface {
 public:
  explicit CarvedSurface(const CarvedField& field);

  /// Makes every block's patch: the whole bone.
  void mesh_all(const CarvedField& field);
  /// Makes anew the patches of blocks that changed since the last call, of a carved bone alone:
  /// blocks that no cut came near have a patch only after mesh_all. Returns these blocks.
  const std::vector<std::uint32_t>& update(const CarvedField& field);
  /// Makes the patches of these blocks, changed or not.
  void mesh(const CarvedField& field, std::span<const std::uint32_t> blocks);

  /// Null where there is no surface.
  const SurfacePatch* patch(std::uint32_t block) const;
  /// Of all patches: closed after mesh_all.
  /// `keys`, if given: of its vertices, rising.
  TriMesh joined(std::vector<std::uint64_t>* keys = nullptr) const;

 private:
  void remesh(const CarvedField& field, std::uint32_t block);
  void find_changed(const CarvedField& field);
  void find_all_carved(const CarvedField& field);
  void add_around(const CarvedField& field, std::uint32_t block, bool all);

  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> slot_;  ///< of each block of the grid: its place in patches_
  std::vector<SurfacePatch> patches_;
  std::vector<std::uint32_t> block_of_;  ///< of each patch
  std::vector<std::uint32_t> free_;      ///< empty patches
  std::vector<std::uint32_t> carved_;    ///< blocks that cuts came near, ever
  std::vector<std::uint32_t> changed_;
  std::vector<std::uint32_t> seen_;  ///< of each block: the last call that listed it
  std::uint32_t call_ = 0;
  std::uint64_t since_ = 0, epoch_ = 0;
};

/// What is left of the bone: closed, manifold, facing outwards. Fails when nothing is.
Result<TriMesh> carved_mesh(const CarvedField& field);
/// A carved field of something else on the same nodes, with these cuts; see below.
Result<CarvedField> same_cuts(const CarvedField& cuts, std::shared_ptr<const UncutField> of);
/// The same cuts in what has its field on the same nodes: in the bone without its cartilage
/// (UncutField::bare), or in a layer (UncutField::make_beside). Fails when nothing is left of it.
Result<TriMesh> carved_mesh(const CarvedField& cuts, std::shared_ptr<const UncutField> of);

}  // namespace osteon
