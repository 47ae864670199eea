#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tet/tet_element.h"
#include "tet/tet_rows.h"

namespace osteon {

/// Memory that work on the points needs.
struct TetPointScratch {
  std::vector<double> turn, force;
};

/// The points of integration of a solid as rows for registers (tet_rows.h), and which of them act
/// on each node. Made once; does what the functions of tet_element.h do, sooner.
class TetPointRows {
 public:
  explicit TetPointRows(const TetSolid& solid);

  /// The rotation at each point, kept in `scratch` for what follows. Of linear solids nothing.
  void rotate(std::span<const Vec3> moved_m, TetPointScratch& scratch) const;
  /// Adds the elastic force at the moved places, with those rotations.
  void add_elastic(std::span<const Vec3> moved_m, TetPointScratch& scratch,
                   std::span<Vec3> force_n) const;
  /// Adds the stiffness with those rotations times `v`, times `factor`.
  void add_stiffness(std::span<const Vec3> v, double factor, TetPointScratch& scratch,
                     std::span<Vec3> out) const;
  void add_neo_hookean(std::span<const Vec3> moved_m, TetPointScratch& scratch,
                       std::span<Vec3> force_n) const;
  /// Mean of those rotations about each node, weighted by volume; the identity of linear solids.
  std::vector<Mat3> node_rotations(const TetPointScratch& scratch) const;

 private:
  tets::TetRows rows(TetPointScratch& scratch) const;
  void gather(const TetPointScratch& scratch, std::span<Vec3> out) const;

  tets::TetModuli moduli_{};
  bool corotated_ = false;
  std::size_t nodes_ = 0, count_ = 0, stride_ = 0;
  std::vector<std::uint32_t> node_;
  std::vector<double> slope_, volume_;
  // Of each node, from first_[n] to first_[n + 1]: where its force stands, and its point.
  std::vector<std::uint32_t> first_, at_, point_;
  std::vector<double> per_volume_;  ///< of each node: 1 / volume about it
};

}  // namespace osteon
