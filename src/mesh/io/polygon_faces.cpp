#include "io/polygon_faces.h"

#include <algorithm>

#include "repair/triangulate_loop.h"

namespace osteon {

bool add_polygon(TriMesh& mesh, const std::vector<std::uint32_t>& corners) {
  const auto is_vertex = [&mesh](std::uint32_t v) { return v < mesh.vertices.size(); };
  if (corners.size() < 3 || corners.size() > kMostCorners ||
      !std::all_of(corners.begin(), corners.end(), is_vertex))
    return false;
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  // Coordinates that are not finite have no least area: the fan keeps the corners, and the reader
  // refuses the vertices later.
  std::vector<Triangle> triangles =
      triangulate_loop(mesh.vertices, corners, [](std::uint32_t, std::uint32_t) { return true; });
  if (triangles.empty())
    for (std::size_t k = 2; k < corners.size(); ++k)
      triangles.push_back({corners[0], corners[k - 1], corners[k]});
  mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  return true;
}

}  // namespace osteon
