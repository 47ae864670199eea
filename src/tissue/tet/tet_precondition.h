#pragma once

#include <memory>
#include <vector>

#include "osteon/tissue/tet_solid.h"

namespace osteon {

/// Weights of mass and stiffness in the matrix of an implicit step: A = mass M + stiffness K.
struct StepWeights {
  double mass = 0, stiffness = 0;
};

using AxisMask = std::vector<std::array<bool, 3>>;  ///< of each node: which axes are held

/// An approximate inverse of the matrix of a step, at rest: the matrix of the corners alone, linear
/// between them, factored (LDL^T); for quadratic elements the diagonal blocks of all nodes are
/// added, which deal with what the corners cannot see. Symmetric and positive.
class TetPreconditioner {
 public:
  TetPreconditioner(const TetSolid& solid, const AxisMask& held, const StepWeights& weights);
  ~TetPreconditioner();
  /// z = about A^-1 r; held axes of both are zero. `turned`: rotation of each node from rest.
  std::vector<Vec3> solve(const std::vector<Vec3>& r, const std::vector<Mat3>& turned) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The slowest swing of a body, rad/s, on its corners alone (so somewhat too quick), by inverse
/// iteration with the matrix of a step of this weight; 0 for a body that can move freely.
double slowest_swing(const TetSolid& solid, const AxisMask& held, double step_s);

}  // namespace osteon
