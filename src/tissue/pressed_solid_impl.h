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
};

struct PressedSolid::Impl {
  FilledCells cells;
  Vec3 up;
  double stiffness_n_per_m = 0, poisson = 0;
  std::vector<std::uint8_t> held, rests;  ///< of each node
  Eigen::MatrixXd lying, lifted;          ///< ways by forces, for a modulus of 1 Pa
  /// Of one that was cut: what it was cut from, and of each part its middle and the parts that it
  /// goes on in.
  std::shared_ptr<const PressedSolid> whole;
  std::vector<Vec3> middles;
  std::vector<std::vector<std::uint32_t>> links;

  double share(const SolidPush& push) const;
  double yields(const SolidPush& at, const SolidPush& push, double share) const;
  Vec3 way(const Eigen::MatrixXd& ways, std::uint32_t node, const SolidPush& push) const;
  SolidPatch patch_of_cut(const Vec3& p) const;
};

/// A support is so many times as stiff as a cell.
inline constexpr double kSupportHolds = 1000;

}  // namespace osteon
