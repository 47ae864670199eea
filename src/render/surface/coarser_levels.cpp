#include "surface/coarser_levels.h"

#include <meshoptimizer.h>

#include <array>

namespace osteon {
namespace {

constexpr std::array<double, 5> kErrors_m = {12.5e-6, 25e-6, 50e-6, 100e-6, 200e-6};
constexpr double kWorthwhile = 0.75;
constexpr std::size_t kFewTriangles = 64;
/// A shade that is off by this share of its range weighs as much as a surface off by the level's
/// error.
constexpr float kShadeTolerance = 0.12f;

float centred(std::uint8_t value) { return static_cast<float>(value) / 255.0f - 0.5f; }

/// Vertices pushed along their normals by their shades: on this surface, what keeps to the shape
/// keeps to the shades too.
std::vector<std::array<float, 3>> relief(const ShadedMesh& mesh, double error_m) {
  const float height_m = static_cast<float>(error_m) / kShadeTolerance;
  std::vector<std::array<float, 3>> out = mesh.positions;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const ShadedMesh::Shade& shade = mesh.shades[k];
    // The mottle shows a third as strongly as the others.
    const float shift =
        height_m * (centred(shade.openness) + centred(shade.cavity) + centred(shade.mottle) / 3);
    for (std::size_t c = 0; c < 3; ++c) out[k][c] += shift * mesh.normals[k][c];
  }
  return out;
}

std::vector<Triangle> simplified(const ShadedMesh& mesh, double error_m) {
  const auto points = relief(mesh, error_m);
  const std::size_t count = 3 * mesh.triangles.size();
  std::vector<unsigned int> indices;
  indices.reserve(count);
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned int> kept(count);
  const float* first = points.front().data();
  constexpr std::size_t kStride = sizeof(points.front());
  const float scale = meshopt_simplifyScale(first, points.size(), kStride);
  const float relative = scale > 0 ? static_cast<float>(error_m) / scale : 0.0f;
  // Of a closed surface borders are the two sides of a sharp edge: they must stay together.
  const unsigned int options = mesh.closed ? meshopt_SimplifyLockBorder : 0;
  kept.resize(meshopt_simplify(kept.data(), indices.data(), count, first, points.size(), kStride, 0,
                               relative, options, nullptr));
  meshopt_optimizeVertexCache(kept.data(), kept.data(), kept.size(), points.size());
  std::vector<Triangle> out;
  for (std::size_t k = 0; k + 2 < kept.size(); k += 3)
    out.push_back({kept[k], kept[k + 1], kept[k + 2]});
  return out;
}

}  // namespace

std::vector<ShadedMesh::Level> coarser_levels(const ShadedMesh& mesh) {
  std::vector<ShadedMesh::Level> levels;
  std::size_t before = mesh.triangles.size();
  for (const double error_m : kErrors_m) {
    if (before <= kFewTriangles) break;
    std::vector<Triangle> triangles = simplified(mesh, error_m);
    const double share = static_cast<double>(triangles.size()) / static_cast<double>(before);
    if (triangles.empty() || share > kWorthwhile) continue;
    before = triangles.size();
    levels.push_back({std::move(triangles), error_m});
  }
  return levels;
}

}  // namespace osteon
