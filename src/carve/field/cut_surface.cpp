#include "osteon/carve/cut_surface.h"

#include <algorithm>
#include <utility>

#include "osteon/base/check.h"
#include "osteon/carve/carved_surface.h"

namespace osteon {
namespace {

void append(const SurfacePatch* patch, bool turned, TriMesh& mesh) {
  if (!patch) return;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), patch->vertices.begin(), patch->vertices.end());
  for (Triangle t : patch->triangles) {
    for (auto& v : t) v += first;
    if (turned) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

}  // namespace

TriMesh cut_surface(const CarvedField& field) {
  TriMesh mesh;
  if (field.block_count() == 0) return mesh;
  const auto whole = CarvedField::make(field.shared_bone(), field.layers(), 1);
  demand(whole.has_value(), "a bone that was carved cannot be made whole");
  CarvedSurface before(*whole), left(field);
  std::vector<std::uint32_t> blocks = left.update(field);
  std::sort(blocks.begin(), blocks.end());
  before.mesh(*whole, blocks);
  for (const std::uint32_t block : blocks) {
    append(before.patch(block), false, mesh);
    append(left.patch(block), true, mesh);
  }
  return mesh;
}

}  // namespace osteon
