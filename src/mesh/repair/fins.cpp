#include "repair/fins.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "repair/clean.h"
#include "repair/edge_counts.h"
#include "repair/patches.h"

namespace osteon {
namespace {

// A patch of more than this share of the whole surface is no fin.
constexpr double kLargestFin = 0.2;

// Leaves whole edges behind where it stood, and had a free rim.
bool is_fin(const TriMesh& mesh, const Patch& patch, EdgeCounts& counts) {
  bool has_rim = false;
  bool stands = false;
  bool leaves_gap = false;
  for (const std::uint32_t t : patch.triangles) {
    const std::array<int, 3> uses = counts.of(mesh.triangles[t]);
    has_rim = has_rim || std::find(uses.begin(), uses.end(), 1) != uses.end();
  }
  for (const std::uint32_t t : patch.triangles) counts.add(mesh.triangles[t], -1);
  for (const std::uint32_t t : patch.triangles) {
    for (const int left : counts.of(mesh.triangles[t])) {
      stands = stands || left == 2;
      leaves_gap = leaves_gap || (left != 0 && left != 2);
    }
  }
  const bool fin = has_rim && stands && !leaves_gap;
  if (!fin)
    for (const std::uint32_t t : patch.triangles) counts.add(mesh.triangles[t], 1);
  return fin;
}

std::size_t sweep(TriMesh& mesh) {
  std::vector<Patch> patches = patches_of(mesh);
  if (patches.size() < 2) return 0;
  std::vector<std::pair<double, std::size_t>> by_area;
  double whole = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    double area = 0;
    for (const std::uint32_t t : patches[p].triangles) area += triangle_area(mesh, t);
    by_area.push_back({area, p});
    whole += area;
  }
  std::sort(by_area.begin(), by_area.end());
  EdgeCounts counts(mesh);
  std::vector<char> dropped(mesh.triangles.size(), 0);
  for (const auto& [area, p] : by_area) {
    if (area > kLargestFin * whole) break;
    if (!is_fin(mesh, patches[p], counts)) continue;
    for (const std::uint32_t t : patches[p].triangles) dropped[t] = 1;
  }
  return erase_marked(mesh, dropped);
}

}  // namespace

std::size_t drop_fins(TriMesh& mesh) {
  constexpr int kSweeps = 8;  // a fin may stand on a fin
  std::size_t dropped = 0;
  for (int i = 0; i < kSweeps; ++i) {
    const std::size_t now = sweep(mesh);
    dropped += now;
    if (now == 0) break;
  }
  return dropped;
}

}  // namespace osteon
