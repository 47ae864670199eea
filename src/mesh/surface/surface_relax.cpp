#include "surface/surface_relax.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace osteon {
namespace {

constexpr double kGradientStep = 0.02;  // of a cell

/// One Newton step along the gradient, which is taken by forward differences.
Vec3 step_to_zero(const LocalField& field, const Vec3& p, double cell) {
  const double h = kGradientStep * cell;
  const double f = field.at(p);
  const Vec3 gradient((field.at(p + Vec3(h, 0, 0)) - f) / h, (field.at(p + Vec3(0, h, 0)) - f) / h,
                      (field.at(p + Vec3(0, 0, h)) - f) / h);
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

/// The field as each vertex sees it, near its first place.
class VertexFields {
 public:
  VertexFields(const LocalField& field, const std::vector<Vec3>& home, double cell)
      : field_(field), home_(home), reach_(kReach * cell), own_(home.size()) {
    // Vertices come in the order of their cells: those of a run lie close together.
    for (std::size_t first = 0; first < home.size(); first += kRun)
      look_near(first, std::min(first + kRun, home.size()));
  }

  Vec3 step_to_zero(std::size_t vertex, const Vec3& p, double cell) const {
    const double within = reach_ - kGradientStep * cell;
    const bool near = own_[vertex] && (p - home_[vertex]).squaredNorm() < within * within;
    return osteon::step_to_zero(near ? *own_[vertex] : field_, p, cell);
  }

 private:
  static constexpr double kReach = 1.0;  // of a cell; beyond, the whole field is asked
  static constexpr std::size_t kRun = 16;

  void look_near(std::size_t first, std::size_t last) {
    Aabb box;
    for (std::size_t i = first; i < last; ++i) box.include(home_[i]);
    const double around = 0.5 * box.extent().norm() + reach_;
    const LocalField::Near run = field_.near(box.center(), around);
    if (!run.field) return;
    for (std::size_t i = first; i < last; ++i) own_[i] = run.field->near(home_[i], reach_).field;
  }

  const LocalField& field_;
  const std::vector<Vec3>& home_;
  double reach_;
  std::vector<std::unique_ptr<const LocalField>> own_;
};

}  // namespace

void relax_on_surface(const LocalField& field,
                      const std::vector<std::array<std::uint32_t, 4>>& quads,
                      const IsosurfaceOptions& options, std::vector<Vec3>& vertices) {
  const double cell = options.cell_m;
  const std::vector<Vec3> home = vertices;
  const VertexFields fields(field, home, cell);
  for (int round = 0; round < options.relax_steps; ++round) {
    const std::vector<Vec3> mean = neighbour_means(quads, vertices);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 evened = 0.5 * (vertices[i] + mean[i]);
      vertices[i] = kept_near(fields.step_to_zero(i, evened, cell), home[i], 0.6 * cell);
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = kept_near(fields.step_to_zero(i, vertices[i], cell), home[i], 0.6 * cell);
}

}  // namespace osteon
