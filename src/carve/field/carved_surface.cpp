#include "osteon/carve/carved_surface.h"

#include <algorithm>
#include <utility>

#include "field/block_surface.h"

namespace osteon {

void SurfacePatch::clear() {
  vertices.clear();
  normals.clear();
  keys.clear();
  triangles.clear();
}

CarvedSurface::CarvedSurface(const CarvedField& field)
    : slot_(field.grid().count(), kNone), seen_(field.grid().count(), 0), epoch_(field.epoch()) {}

const SurfacePatch* CarvedSurface::patch(std::uint32_t block) const {
  return slot_[block] == kNone ? nullptr : &patches_[slot_[block]];
}

void CarvedSurface::remesh(const CarvedField& field, std::uint32_t block) {
  const std::array<int, 3> at = field.grid().place(block);
  NodeWindow window;
  read_window(field, at, window);
  if (slot_[block] == kNone) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(patches_.size()));
      patches_.emplace_back();
      block_of_.push_back(0);
    }
    slot_[block] = free_.back();
    free_.pop_back();
    block_of_[slot_[block]] = block;
  }
  SurfacePatch& patch = patches_[slot_[block]];
  make_patch(window, field.grid(), at, patch);
  if (!patch.triangles.empty()) return;
  free_.push_back(slot_[block]);
  slot_[block] = kNone;
}

void CarvedSurface::mesh_all(const CarvedField& field) {
  (void)update(field);
  for (std::uint32_t block = 0; block < slot_.size(); ++block) {
    const bool deep = field.bone().place(block) == UncutField::Place::kDeep;
    // All nodes of a deep block that no cut came near are bone, those beside it too.
    if (deep && !field.cuts(block)) continue;
    if (seen_[block] != call_) remesh(field, block);
  }
}

/// Lists blocks about one whose cuts changed.
void CarvedSurface::add_around(const CarvedField& field, std::uint32_t block, bool all) {
  const BlockGrid& grid = field.grid();
  const auto at = grid.place(block);
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> near{at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1};
    if (!grid.holds(near)) continue;
    const std::uint32_t index = grid.index(near);
    if (seen_[index] == call_ || (!all && !field.surface_changed(index, since_))) continue;
    seen_[index] = call_;
    changed_.push_back(index);
  }
}

void CarvedSurface::find_changed(const CarvedField& field) {
  for (std::size_t n = 0; n < field.block_count(); ++n)
    if (field.changed_at(n) > since_) add_around(field, field.block_at(n), false);
}

void CarvedSurface::find_all_carved(const CarvedField& field) {
  for (std::size_t n = 0; n < field.block_count(); ++n) add_around(field, field.block_at(n), true);
  for (const std::uint32_t block : carved_) {
    if (seen_[block] == call_) continue;
    seen_[block] = call_;
    changed_.push_back(block);
  }
}

const std::vector<std::uint32_t>& CarvedSurface::update(const CarvedField& field) {
  ++call_;
  changed_.clear();
  if (field.epoch() != epoch_) {
    find_all_carved(field);
    carved_.clear();
  } else {
    find_changed(field);
  }
  carved_.insert(carved_.end(), changed_.begin(), changed_.end());
  std::sort(carved_.begin(), carved_.end());
  carved_.erase(std::unique(carved_.begin(), carved_.end()), carved_.end());
  for (const std::uint32_t block : changed_) remesh(field, block);
  since_ = field.step();
  epoch_ = field.epoch();
  return changed_;
}

void CarvedSurface::mesh(const CarvedField& field, std::span<const std::uint32_t> blocks) {
  for (const std::uint32_t block : blocks) remesh(field, block);
}

// Vertices under one key are one. In order of blocks, so that the same field gives the same bytes
// whatever was meshed before.
TriMesh CarvedSurface::joined(std::vector<std::uint64_t>* keys) const {
  struct Use {
    std::uint64_t key;
    std::uint32_t place;  // among all patches' vertices in order
  };
  std::vector<Use> uses;
  std::vector<const SurfacePatch*> order;
  for (const std::uint32_t slot : slot_)
    if (slot != kNone) order.push_back(&patches_[slot]);
  for (const SurfacePatch* patch : order)
    for (const std::uint64_t key : patch->keys)
      uses.push_back({key, static_cast<std::uint32_t>(uses.size())});
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::pair(a.key, a.place) < std::pair(b.key, b.place);
  });
  std::vector<std::uint32_t> vertex(uses.size());
  std::uint32_t count = 0;
  for (std::size_t n = 0; n < uses.size(); ++n) {
    if (n > 0 && uses[n].key != uses[n - 1].key) ++count;
    vertex[uses[n].place] = count;
  }
  if (keys) {
    keys->clear();
    for (std::size_t n = 0; n < uses.size(); ++n)
      if (n == 0 || uses[n].key != uses[n - 1].key) keys->push_back(uses[n].key);
  }
  TriMesh mesh;
  mesh.vertices.resize(uses.empty() ? 0 : count + 1);
  std::size_t first = 0;
  for (const SurfacePatch* patch : order) {
    for (std::size_t v = 0; v < patch->vertices.size(); ++v)
      mesh.vertices[vertex[first + v]] = patch->vertices[v];
    for (const Triangle& t : patch->triangles)
      mesh.triangles.push_back({vertex[first + t[0]], vertex[first + t[1]], vertex[first + t[2]]});
    first += patch->vertices.size();
  }
  return mesh;
}

Result<TriMesh> carved_mesh(const CarvedField& field) {
  CarvedSurface surface(field);
  surface.mesh_all(field);
  TriMesh mesh = surface.joined();
  if (mesh.triangles.empty())
    return fail("nothing of the bone remains", "carving", "Use a smaller tool or another path");
  return mesh;
}

Result<CarvedField> same_cuts(const CarvedField& cuts, std::shared_ptr<const UncutField> of) {
  auto same =
      CarvedField::make(std::move(of), cuts.layers(), std::max<std::size_t>(1, cuts.block_count()));
  if (!same) return same;
  for (std::size_t n = 0; n < cuts.block_count(); ++n) {
    const std::uint32_t block = cuts.block_at(n);
    const std::span<const std::int16_t, BlockGrid::kNodes> nodes(cuts.cuts(block),
                                                                 BlockGrid::kNodes);
    (void)same->apply(block, nodes, 1);  // outside of it there is nothing to cut
  }
  return same;
}

Result<TriMesh> carved_mesh(const CarvedField& cuts, std::shared_ptr<const UncutField> of) {
  const auto same = same_cuts(cuts, std::move(of));
  if (!same) return tl::unexpected(same.error());
  return carved_mesh(*same);
}

}  // namespace osteon
