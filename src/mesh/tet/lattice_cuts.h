#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tet/bcc_lattice.h"

namespace osteon {

/// Where the surface crosses the edges of a lattice, and the lattice points that were warped onto
/// it: after that no crossing lies closer to a lattice point than a fixed share of its edge.
class LatticeCuts {
 public:
  /// Finds the crossings, then warps; `lattice` learns which of its points lie on the surface.
  LatticeCuts(BccLattice& lattice, const ScalarField& field);

  /// Of a point as it lies now.
  Vec3 place(std::uint32_t point) const;
  /// Of the crossing between an inside and an outside point.
  Vec3 place(std::uint32_t inside, std::uint32_t outside) const;

 private:
  struct Cut {
    std::uint64_t key;  ///< inside point, outside point
    Vec3 place;
    double share;  ///< of the edge, from inside
  };
  void find(const ScalarField& field);
  void warp();
  void consider(const Cut& cut, std::uint32_t point, double share, const Cut*& best,
                double& best_length) const;

  BccLattice& lattice_;
  std::vector<Cut> cuts_;                           ///< by key
  std::unordered_map<std::uint32_t, Vec3> warped_;  ///< looked up, never walked
};

}  // namespace osteon
