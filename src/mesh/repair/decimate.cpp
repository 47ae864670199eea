#include "osteon/mesh/decimate.h"

#include <meshoptimizer.h>

#include "osteon/mesh/measure.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

TriMesh simplified(const TriMesh& mesh, double error_m, std::size_t least_triangles) {
  // Single precision is kept for lengths near zero.
  const Vec3 middle = bounds(mesh).center();
  std::vector<float> positions;
  for (const Vec3& v : mesh.vertices)
    for (int a = 0; a < 3; ++a) positions.push_back(static_cast<float>(v[a] - middle[a]));
  std::vector<unsigned> indices;
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  const float scale =
      meshopt_simplifyScale(positions.data(), mesh.vertices.size(), 3 * sizeof(float));
  std::vector<unsigned> fewer(indices.size());
  const std::size_t count = meshopt_simplify(
      fewer.data(), indices.data(), indices.size(), positions.data(), mesh.vertices.size(),
      3 * sizeof(float), 3 * least_triangles, static_cast<float>(error_m) / scale, 0, nullptr);
  TriMesh out;
  out.vertices = mesh.vertices;
  for (std::size_t n = 0; n + 2 < count; n += 3)
    out.triangles.push_back({fewer[n], fewer[n + 1], fewer[n + 2]});
  return out;
}

}  // namespace

void decimate(TriMesh& mesh, double error_m, std::size_t least_triangles) {
  if (mesh.triangles.size() <= least_triangles) return;
  const bool closed = topology(mesh).closed();
  // Where an edge collapse pinches the surface, repair cuts the pinch off, or less is collapsed.
  for (const double share : {1.0, 0.6, 0.3, 0.1}) {
    TriMesh fewer = simplified(mesh, share * error_m, least_triangles);
    if (fewer.triangles.empty()) continue;
    if (closed) {
      repair(fewer, {.weld_distance_m = 0});
      if (!topology(fewer).closed()) continue;
    } else {
      weld_vertices(fewer, 0);
    }
    mesh = std::move(fewer);
    return;
  }
}

}  // namespace osteon
