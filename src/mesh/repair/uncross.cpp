#include "repair/uncross.h"

#include "osteon/mesh/self_crossing.h"

namespace osteon {
namespace {

constexpr int kRounds = 12;
constexpr int kRoundsARing = 3;  // after so many a further ring of neighbours is drawn back too

/// The vertices of all triangles that have a chosen vertex.
void choose_neighbours(const TriMesh& mesh, std::vector<bool>& chosen) {
  const std::vector<bool> before = chosen;
  for (const Triangle& t : mesh.triangles)
    if (before[t[0]] || before[t[1]] || before[t[2]])
      for (const std::uint32_t v : t) chosen[v] = true;
}

}  // namespace

bool uncross(TriMesh& mesh, const std::vector<Vec3>& home) {
  for (int round = 0; round < kRounds; ++round) {
    const auto crossings = self_crossings(mesh, mesh.triangles.size());
    if (crossings.empty()) return true;
    std::vector<bool> chosen(mesh.vertices.size(), false);
    for (const auto& [a, b] : crossings)
      for (const std::uint32_t t : {a, b})
        for (const std::uint32_t v : mesh.triangles[t]) chosen[v] = true;
    for (int ring = 0; ring < round / kRoundsARing; ++ring) choose_neighbours(mesh, chosen);
    for (std::size_t v = 0; v < chosen.size(); ++v)
      if (chosen[v]) mesh.vertices[v] = 0.5 * (mesh.vertices[v] + home[v]);
  }
  return self_crossings(mesh, 1).empty();
}

}  // namespace osteon
