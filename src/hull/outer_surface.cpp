#include "outer_surface.h"

#include <cstdint>
#include <vector>

#include "osteon/base/union_find.h"

namespace osteon::hull {
TriMesh outer_surface(const TriMesh& mesh) {
  UnionFind sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[1], t[2]);
  }
  // Six times the volume of each connected part, under the name of its set.
  std::vector<double> volume(mesh.vertices.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[sets.find(t[0])];
    volume[sets.find(t[0])] +=
        (mesh.vertices[t[0]] - a).dot((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a));
  }
  TriMesh out;
  std::vector<std::uint32_t> number(mesh.vertices.size(), 0xffffffffu);
  for (const Triangle& t : mesh.triangles) {
    if (volume[sets.find(t[0])] < 0) continue;
    Triangle kept{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (number[t[k]] == 0xffffffffu) {
        number[t[k]] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[t[k]]);
      }
      kept[k] = number[t[k]];
    }
    out.triangles.push_back(kept);
  }
  return out;
}

}  // namespace osteon::hull
