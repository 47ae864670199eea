#include "soft/cut_shape.h"

#include <algorithm>
#include <utility>

#include "soft/solid_cutting.h"

namespace osteon {
namespace {

const CarveState::Block* block_of(const CarveState& cuts, std::uint32_t block) {
  const auto at = std::lower_bound(
      cuts.blocks.begin(), cuts.blocks.end(), block,
      [](const CarveState::Block& one, std::uint32_t index) { return one.block < index; });
  return at != cuts.blocks.end() && at->block == block ? &*at : nullptr;
}

}  // namespace

// Where every block that holds cuts still does, those that differ are copied; else all are.
bool CutShape::take(const CarveState& cuts) {
  if (cuts.bone != field_->bone().hash()) return false;
  bool held = true;
  for (std::size_t n = 0; n < field_->block_count(); ++n)
    held = held && block_of(cuts, field_->block_at(n)) != nullptr;
  if (!held) return field_->restore(cuts).has_value();
  const std::uint64_t step = field_->step() + 1;
  for (const CarveState::Block& block : cuts.blocks) {
    const std::int16_t* now = field_->cuts(block.block);
    if (now && std::equal(block.cut.begin(), block.cut.end(), now)) continue;
    if (!field_->apply(block.block, block.cut, step)) return false;
  }
  return true;
}

bool CutShape::show(const CarveState& cuts) {
  if (!field_) {
    auto field = CarvedField::make(solid_->uncut, {}, kMostCutBlocks, kSolidCutAir_m);
    if (!field) return false;
    field_.emplace(std::move(*field));
  }
  if (!take(cuts)) return false;
  if (surface_) {
    (void)surface_->update(*field_);
  } else {
    surface_.emplace(*field_);
    surface_->mesh_all(*field_);
  }
  std::vector<std::uint64_t> keys;
  TriMesh mesh_B = surface_->joined(&keys);
  find_patches(std::move(keys), std::move(mesh_B));
  return true;
}

// Both lists of keys rise: a vertex that stands where it stood under its key keeps its patch.
void CutShape::find_patches(std::vector<std::uint64_t> keys, TriMesh mesh_B) {
  std::vector<SolidPatch> patches(keys.size());
  std::size_t old = 0;
  for (std::size_t v = 0; v < keys.size(); ++v) {
    while (old < keys_.size() && keys_[old] < keys[v]) ++old;
    const bool same =
        old < keys_.size() && keys_[old] == keys[v] && mesh_B_.vertices[old] == mesh_B.vertices[v];
    patches[v] = same ? patches_[old] : solid_->body->patch_at(mesh_B.vertices[v]);
  }
  patches_ = std::move(patches);
  keys_ = std::move(keys);
  mesh_B_ = std::move(mesh_B);
}

}  // namespace osteon
