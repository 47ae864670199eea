#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/tissue/solid_state.h"
#include "osteon/tissue/solve_scene.h"

namespace osteon {

struct SolveProbe {
  Vec3 at_m = Vec3::Zero();  ///< in the body at rest
  Vec3 moved_m = Vec3::Zero();
};

/// Force of a support on the body.
struct SolveReaction {
  bool of_moved = false;
  std::size_t index = 0;  ///< in the scene's list
  Vec3 force_n = Vec3::Zero();
  std::optional<Vec3> moment_n_m =
      std::nullopt;  ///< rods: about the middle of the nodes that it holds
};

/// Where and when a solver lost its footing; the result is the last sound state before it.
struct SolveLost {
  std::string part;
  Vec3 at_m = Vec3::Zero();
  double time_s = 0;
};

/// The body as it is now, for a file: cells of one kind.
struct SolveShape {
  std::vector<Vec3> points_m;
  std::vector<Vec3> moved_m;  ///< of each point, from its rest place
  std::vector<std::uint32_t> corners;
  std::size_t corners_a_cell = 0;  ///< 3 triangle, 4 tetrahedron, 8 hexahedron (VTK's order)
};

struct SolveResult {
  std::vector<SolveProbe> probes;
  std::vector<SolveReaction> reactions;
  SolidEnergy energy;
  std::size_t elements = 0;
  std::uint64_t steps = 0;  ///< done
  double step_s = 0;
  /// The body is at rest: during the last tenth of the time its kinetic energy stayed below a
  /// hundred-thousandth of what its deformation holds and of the highest that it had.
  bool settled = false;
  std::optional<SolveLost> lost;
  SolveShape shape;
};

/// Solves a scene from rest. Fails, naming the key, on a box without nodes, a probe outside the
/// body, a mesh with inverted elements or of several parts, and on a model that does not fit the
/// body. The same scene gives the same bits.
Result<SolveResult> solve(const SolveScene& scene);

/// A legacy VTK file (ASCII, mm): the moved body, with the displacements `moved_mm` of its points.
std::string solve_vtk(const SolveShape& shape);

}  // namespace osteon
