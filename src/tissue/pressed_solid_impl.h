#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/tissue/pressed_solid.h"

namespace osteon {

/// Cubes that hold some of a solid, and their corners.
struct FilledCells {
  double cell_m = 0;
  std::vector<std::array<std::uint32_t, 8>> corners;  ///< of each cell, x fastest
  std::vector<double> fill;                           ///< of each cell
  std::vector<Vec3> nodes;
  Vec3 fibres = Vec3::UnitX();
  std::vector<double> pull;  ///< of each cell, tension along them over the modulus; or none
};

/// A corner's way from the middle of a cell of edge 2, along the fibres. Its share in the slope of
/// a way along them is this / (4 edge).
inline double along_fibres(const FilledCells& cells, std::size_t corner) {
  return ((corner & 1) ? 1 : -1) * cells.fibres.x() + ((corner & 2) ? 1 : -1) * cells.fibres.y() +
         ((corner & 4) ? 1 : -1) * cells.fibres.z();
}

/// What a cell's tension adds to the stiffness between two of its corners, the same for each axis:
/// tension x slope x slope x volume, at the cell's middle, for a modulus of 1 Pa.
inline double pulled_stiffness(const FilledCells& cells, std::size_t cell, std::size_t a,
                               std::size_t b) {
  if (cells.pull.empty()) return 0;
  return cells.fill[cell] * cells.pull[cell] * cells.cell_m / 16 * along_fibres(cells, a) *
         along_fibres(cells, b);
}

struct PressedSolid::Impl {
  FilledCells cells;
  Vec3 up;
  double stiffness_n_per_m = 0, poisson = 0;
  double young_pa = 0;                    ///< 0: as stiff as wanted wherever it is pressed
  std::vector<std::uint8_t> held, rests;  ///< of each node
  Eigen::MatrixXd lying, lifted;          ///< ways by forces, for a modulus of 1 Pa
  /// Of one that was cut: what it was cut from, and of each part its middle and the parts that it
  /// goes on in.
  std::shared_ptr<const PressedSolid> whole;
  std::vector<Vec3> middles;
  std::vector<std::vector<std::uint32_t>> links;

  bool can_lie() const;  ///< something of it rests and is not held: else `lying` is `lifted`
  double share(const SolidPush& push) const;
  double yields(const SolidPush& at, const SolidPush& push, double share) const;
  Vec3 way(const Eigen::MatrixXd& ways, std::uint32_t node, const SolidPush& push) const;
  SolidPatch patch_of_cut(const Vec3& p) const;
};

/// A support is so many times as stiff as a cell.
inline constexpr double kSupportHolds = 1000;

}  // namespace osteon
