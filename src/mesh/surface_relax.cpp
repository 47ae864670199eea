#include "surface_relax.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

/// One Newton step along the gradient, which is taken by forward differences.
Vec3 step_to_zero(const ScalarField& field, const Vec3& p, double cell) {
  const double h = 0.02 * cell;
  const double f = field(p);
  const Vec3 gradient((field(p + Vec3(h, 0, 0)) - f) / h, (field(p + Vec3(0, h, 0)) - f) / h,
                      (field(p + Vec3(0, 0, h)) - f) / h);
  const double g2 = gradient.squaredNorm();
  if (g2 < 1e-4) return p;
  const Vec3 step = (f / g2) * gradient;
  const double length = step.norm();
  return p - step * std::min(1.0, 0.5 * cell / std::max(length, 1e-300));
}

Vec3 kept_near(const Vec3& p, const Vec3& home, double radius) {
  const double far = (p - home).norm();
  return far <= radius ? p : Vec3(home + (p - home) * (radius / far));
}

std::vector<Vec3> neighbour_means(const std::vector<std::array<std::uint32_t, 4>>& quads,
                                  const std::vector<Vec3>& vertices) {
  std::vector<Vec3> mean(vertices.size(), Vec3::Zero());
  std::vector<int> count(vertices.size(), 0);
  for (const auto& q : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      mean[q[k]] += vertices[q[(k + 1) % 4]] + vertices[q[(k + 3) % 4]];
      count[q[k]] += 2;
    }
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] /= count[i];
  return mean;
}

}  // namespace

void relax_on_surface(const ScalarField& field,
                      const std::vector<std::array<std::uint32_t, 4>>& quads,
                      const IsosurfaceOptions& options, std::vector<Vec3>& vertices) {
  const double cell = options.cell_m;
  const std::vector<Vec3> home = vertices;
  for (int round = 0; round < options.relax_steps; ++round) {
    const std::vector<Vec3> mean = neighbour_means(quads, vertices);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 evened = 0.5 * (vertices[i] + mean[i]);
      vertices[i] = kept_near(step_to_zero(field, evened, cell), home[i], 0.6 * cell);
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = kept_near(step_to_zero(field, vertices[i], cell), home[i], 0.6 * cell);
}

}  // namespace osteon
