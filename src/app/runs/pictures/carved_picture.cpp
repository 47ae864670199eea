#include "runs/pictures/carved_picture.h"

#include <algorithm>
#include <cmath>

#include "osteon/carve/removed.h"

namespace osteon {
namespace {

// Surfaces of a block may fall short of it by a cell.
constexpr double kOverlapCells = 1.5;

// How deep a point lies under the surface of the whole bone, by the nearest node.
double depth_m(const CarvedField& field, const Vec3& p_B) {
  const BlockGrid& grid = field.grid();
  const Vec3 u = (p_B - grid.lo) / grid.cell_m;
  std::array<int, 3> at{}, in{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::floor(u[static_cast<Eigen::Index>(k)] + 0.5);
    if (!(x >= 0 && x < BlockGrid::kSide * grid.blocks[k])) return 0;
    at[k] = static_cast<int>(x) / BlockGrid::kSide;
    in[k] = static_cast<int>(x) % BlockGrid::kSide;
  }
  const std::uint32_t block = grid.index(at);
  const std::int16_t* heights = field.heights(block);
  if (!heights) heights = field.bone().stored(block);
  const auto node = static_cast<std::size_t>((in[2] * 8 + in[1]) * 8 + in[0]);
  return std::max(0.0, heights ? -1e-6 * heights[node] : -field.bone().middle_m(block));
}

SurfaceCube cube_of(const CarvedField& field, std::uint32_t block, const SurfacePatch* patch) {
  SurfaceCube cube;
  cube.cube = block;
  if (!patch) return cube;
  cube.vertices = patch->vertices;
  cube.normals = patch->normals;
  cube.triangles = patch->triangles;
  for (const Vec3& v : cube.vertices) cube.depth_m.push_back(static_cast<float>(depth_m(field, v)));
  return cube;
}

}  // namespace

CarvedPicture::CarvedPicture(std::shared_ptr<const CarvingSetup> setup)
    : setup_(std::move(setup)), bones_(setup_ ? setup_->bones.size() : 0) {}

CarvedPicture::Bone* CarvedPicture::bone(std::uint32_t index) {
  if (index >= bones_.size() || !setup_->bones[index]) return nullptr;
  std::optional<Bone>& of = bones_[index];
  if (of) return &*of;
  auto field =
      CarvedField::make(setup_->bones[index], setup_->layers, setup_->most_blocks, setup_->air_m);
  if (!field) return nullptr;
  CarvedSurface surface(*field);
  of.emplace(Bone{std::move(*field), std::move(surface)});
  return &*of;
}

void CarvedPicture::take(const CutsPatch& patch) {
  const bool known = patch.bone < bones_.size() && bones_[patch.bone].has_value();
  if (patch.clear && !known) return;  // whole as it is
  Bone* of = bone(patch.bone);
  if (!of) return;
  of->waits = true;
  of->counted = false;
  if (patch.clear)
    (void)of->field.restore({of->field.bone().hash(), of->field.step() + 1, {}});
  else
    (void)of->field.apply(patch.block, patch.cut, of->field.step() + 1);
}

void CarvedPicture::make_whole() {
  CutsPatch patch;
  patch.clear = true;
  for (patch.bone = 0; patch.bone < bones_.size(); ++patch.bone) take(patch);
}

ByTissue CarvedPicture::removed() {
  ByTissue all{};
  for (std::optional<Bone>& of : bones_) {
    if (!of) continue;
    if (!of->counted) of->gone_m3 = removed_volume(of->field);
    of->counted = true;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] += of->gone_m3[k];
  }
  return all;
}

CutBones CarvedPicture::cut_bones() const {
  CutBones out;
  for (std::uint32_t b = 0; b < bones_.size(); ++b)
    if (bones_[b] && bones_[b]->field.block_count() > 0) out.emplace_back(b, bones_[b]->field);
  return out;
}

std::vector<CarvedPicture::Changed> CarvedPicture::changes() {
  std::vector<Changed> out;
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    std::optional<Bone>& of = bones_[b];
    if (!of || !of->waits) continue;
    of->waits = false;
    const BlockGrid& grid = of->field.grid();
    Changed& changed = out.emplace_back();
    changed.bone = BoneId{b};
    changed.grid = {grid.lo, grid.block_m(), grid.blocks, kOverlapCells * grid.cell_m};
    for (const std::uint32_t block : of->surface.update(of->field))
      changed.cubes.push_back(cube_of(of->field, block, of->surface.patch(block)));
  }
  return out;
}

}  // namespace osteon
