#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// A triangle of the sheet at rest.
struct SheetElement {
  std::array<SheetPoint, 3> slope;  ///< gradients of the three hat functions
  double area = 0;
};
SheetElement element_of(const SplitSheet& split, const Triangle& t);

/// Plane stress of the membrane: N = C : grad u.
struct MembraneStiffness {
  explicit MembraneStiffness(const SheetMaterial& m)
      : nu(m.poisson), c(m.stretch_n_per_m / (1 - nu * nu)), g(0.5 * (1 - nu) * c) {}

  /// Of two hat functions with slopes p and q, for each area.
  Eigen::Matrix2d between(const SheetPoint& p, const SheetPoint& q) const {
    Eigen::Matrix2d out;
    out << c * p.x() * q.x() + g * p.y() * q.y(), c * nu * p.x() * q.y() + g * p.y() * q.x(),
        c * nu * p.y() * q.x() + g * p.x() * q.y(), c * p.y() * q.y() + g * p.x() * q.x();
    return out;
  }
  std::array<double, 3> tension(const Eigen::Matrix2d& grad) const {
    return {c * (grad(0, 0) + nu * grad(1, 1)), c * (grad(1, 1) + nu * grad(0, 0)),
            g * (grad(0, 1) + grad(1, 0))};
  }

  double nu, c, g;
};

/// Of a tension xx, yy, xy: the part that pulls, since skin folds rather than pushes.
std::array<double, 3> pulling_part(const std::array<double, 3>& tension);

}  // namespace osteon
