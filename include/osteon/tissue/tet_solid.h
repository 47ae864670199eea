#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tet_mesh.h"
#include "osteon/tissue/hex_solid.h"
#include "osteon/tissue/solid_material.h"
#include "osteon/tissue/solid_state.h"
#include "osteon/tissue/supports.h"

namespace osteon {

/// Displacements inside a tetrahedron: linear between its corners, or quadratic with a node in the
/// middle of each edge. Linear ones are too stiff in bending and where the volume hardly changes.
enum class TetOrder { kLinear, kQuadratic };

/// Every cube as six tetrahedra about the same diagonal (Kuhn 1960), so that faces fit.
TetMesh split_into_tetrahedra(const HexGrid& grid);

struct TetSolidDef {
  TetMesh mesh;
  SolidMaterial material;
  TetOrder order = TetOrder::kQuadratic;
  /// Strain measured against the material turned as it is there (corotated); else small-strain
  /// linear.
  bool corotated = false;
};

struct TetElement {
  std::array<std::uint32_t, 10> node{};  ///< corners, then middles of edges 01 02 03 12 13 23
  std::array<Vec3, 4> slope;             ///< gradients of the barycentric coordinates, 1/m
  double volume_m3 = 0;
};

/// An elastic solid of tetrahedra, made once. Nodes are slots: corners first, as in the mesh.
struct TetSolid {
  SolidMaterial material;
  TetOrder order = TetOrder::kQuadratic;
  bool corotated = false;
  std::size_t corners = 0;
  std::vector<Vec3> rest_W;
  std::vector<double> mass_kg;  ///< of each node, lumped
  std::vector<TetElement> elements;

  std::size_t nodes_an_element() const { return order == TetOrder::kQuadratic ? 10 : 4; }
};

/// Fails on a mesh without elements, with an inverted or flat one, with points that no element has
/// or of several parts.
Result<TetSolid> make_tet_solid(const TetSolidDef& def);

/// Elastic force on every node, newtons (minus the slope of the energy).
SolidState::Field elastic_forces(const TetSolid& solid, const SolidState& state);

/// What an implicit step needs beside the solid: supports, the length of a step, and the stiffness
/// at rest, factored. Made once; steps only read it.
class TetStepper {
 public:
  TetStepper(TetSolid solid, Supports supports, double step_s);
  ~TetStepper();
  TetStepper(TetStepper&&) noexcept;

  const TetSolid& solid() const;
  double step_s() const;
  SolidState rest_state() const;

  /// One implicit step: generalized-alpha (Chung and Hulbert 1993, rho 0.8), stable for any length.
  /// The equations are solved by conjugate gradients, preconditioned by the factored stiffness of
  /// the corners at rest turned with the nodes (warped stiffness, Mueller and others 2002), to 1e-7
  /// of the forces. A function of the state alone, which is not moved when no balance is found.
  /// False then.
  bool step(SolidState& state) const;

  SolidEnergy energy(const SolidState& state) const;
  std::vector<Vec3> reactions(const SolidState& state) const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// A step that resolves the slowest swing of the body under these supports forty times, and the
/// ramps of its loads; between a thousandth and a two-hundredth of `time_s`.
double fitting_step_s(const TetSolid& solid, const Supports& supports, double time_s);

/// The first element that is turned inside out (corotated) or not finite.
std::optional<LostElement> find_lost(const TetSolid& solid, const SolidState& state);

/// A point in a solid at rest and the nodes that move it.
struct TetPoint {
  std::size_t element = 0;
  std::array<double, 10> weight{};
};
/// None outside the solid by more than a millionth of the element's size.
std::optional<TetPoint> find_point(const TetSolid& solid, const Vec3& p_W);
Vec3 moved_at(const TetSolid& solid, const SolidState& state, const TetPoint& point);

}  // namespace osteon
