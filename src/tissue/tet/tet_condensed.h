#pragma once

#include "osteon/tissue/tet_solid.h"

namespace osteon {

/// The static answer of a linear solid, by its surface alone (Bro-Nielsen 1998): with s the nodes
/// of the surface and i those inside,
///   K* = K_ss - K_si K_ii^-1 K_is,  f* = f_s - K_si K_ii^-1 f_i,  K* u_s = f*.
/// What K* needs is made once; new loads cost a solution of the surface's size.
class CondensedSolid {
 public:
  /// Fails on a body whose supports leave it free to move, and on a surface too large.
  static Result<CondensedSolid> make(TetSolid solid, Supports supports);
  ~CondensedSolid();
  CondensedSolid(CondensedSolid&&) noexcept;

  const TetSolid& solid() const;
  std::size_t surface_nodes() const;
  /// At rest under the loads and ways of a time; nodes inside follow the surface.
  SolidState solve(double time_s) const;
  double strain_j(const SolidState& state) const;
  /// Force of each support on the body, newtons, by entry.
  std::vector<Vec3> reactions(const SolidState& state, double time_s) const;

  struct Impl;

 private:
  explicit CondensedSolid(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Nodes of the faces that one element alone has, in order.
std::vector<std::uint32_t> surface_nodes(const TetSolid& solid);

}  // namespace osteon
