#include "osteon/mesh/taubin.h"

namespace osteon {
namespace {

void step(const VertexRings& rings, double factor, std::vector<Vec3>& vertices) {
  const std::vector<Vec3> old = vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::uint32_t begin = rings.first[v], end = rings.first[v + 1];
    if (begin == end) continue;
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t n = begin; n < end; ++n) sum += old[rings.neighbour[n]];
    vertices[v] += factor * (sum / (end - begin) - old[v]);
  }
}

}  // namespace

// In a closed mesh each edge runs once either way, so one direction a triangle names every
// neighbour once.
VertexRings vertex_rings(const TriMesh& mesh) {
  VertexRings rings;
  rings.first.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++rings.first[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) rings.first[v + 1] += rings.first[v];
  rings.neighbour.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(rings.first.begin(), rings.first.end() - 1);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) rings.neighbour[next[t[c]]++] = t[(c + 1) % 3];
  return rings;
}

void smooth_taubin(TriMesh& mesh, const TaubinOptions& options) {
  const VertexRings rings = vertex_rings(mesh);
  for (int round = 0; round < options.rounds; ++round) {
    step(rings, options.lambda, mesh.vertices);
    step(rings, options.mu, mesh.vertices);
  }
}

}  // namespace osteon
