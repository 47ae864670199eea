#pragma once

#include <array>
#include <cstddef>

#include "osteon/tissue/tet_solid.h"

namespace osteon {

/// Corners at the ends of the edges whose middles are nodes 4 to 9.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Points of integration by their barycentric coordinates: one for linear elements, four of equal
/// weight for quadratic ones (exact for polynomials of degree 2).
struct TetPoints {
  std::size_t count;
  std::array<std::array<double, 4>, 4> at;
};
inline const TetPoints& points_of(TetOrder order) {
  constexpr double a = 0.58541019662496845, b = 0.13819660112501052;
  static constexpr TetPoints kOne{1, {{{0.25, 0.25, 0.25, 0.25}}}};
  static constexpr TetPoints kFour{4, {{{a, b, b, b}, {b, a, b, b}, {b, b, a, b}, {b, b, b, a}}}};
  return order == TetOrder::kQuadratic ? kFour : kOne;
}

/// Vectors at an element's nodes, and the sums of them that belong to the barycentric slopes.
using NodeVectors = std::array<Vec3, 10>;
using CornerVectors = std::array<Vec3, 4>;

/// grad u = sum_k w_k (x) slope_k at a point with coordinates l. Shape functions: l_i of a linear
/// element; l_i (2 l_i - 1) and 4 l_i l_j of a quadratic one.
inline CornerVectors slope_weights(TetOrder order, const std::array<double, 4>& l,
                                   const NodeVectors& u) {
  if (order == TetOrder::kLinear) return {u[0], u[1], u[2], u[3]};
  CornerVectors w;
  for (std::size_t i = 0; i < 4; ++i) w[i] = (4 * l[i] - 1) * u[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kTetEdges[e];
    w[i] += (4 * l[j]) * u[4 + e];
    w[j] += (4 * l[i]) * u[4 + e];
  }
  return w;
}

/// The transpose: adds to node vectors what belongs to the slopes.
inline void add_to_nodes(TetOrder order, const std::array<double, 4>& l, const CornerVectors& w,
                         NodeVectors& f) {
  if (order == TetOrder::kLinear) {
    for (std::size_t i = 0; i < 4; ++i) f[i] += w[i];
    return;
  }
  for (std::size_t i = 0; i < 4; ++i) f[i] += (4 * l[i] - 1) * w[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kTetEdges[e];
    f[4 + e] += (4 * l[j]) * w[i] + (4 * l[i]) * w[j];
  }
}

inline Mat3 gradient(const std::array<Vec3, 4>& slope, const CornerVectors& w) {
  Mat3 h = w[0] * slope[0].transpose();
  for (std::size_t k = 1; k < 4; ++k) h += w[k] * slope[k].transpose();
  return h;
}

/// The rotation nearest to F (polar decomposition): Newton's iteration R <- (R + R^-T) / 2, which
/// converges quadratically from any F of positive determinant; else by singular values, with the
/// smallest one's sign turned (Irving, Teran, Fedkiw 2004).
Mat3 rotation_of(const Mat3& f);

/// Rotation at each point of integration, element by element; the identity for linear solids. With
/// these the stress is the slope of mu |F - R|^2 + lambda/2 tr(R^T F - 1)^2: the part of the slope
/// through R vanishes, since R is the nearest rotation.
std::vector<Mat3> rotations(const TetSolid& solid, const SolidState::Field& moved_m);

/// Adds the elastic force at the moved places, times `factor`.
void add_elastic(const TetSolid& solid, const SolidState::Field& moved_m,
                 const std::vector<Mat3>& turned, double factor, std::vector<Vec3>& force_n);

/// Adds the stiffness with these rotations times `v`, times `factor`.
void add_stiffness(const TetSolid& solid, const std::vector<Mat3>& turned,
                   const std::vector<Vec3>& v, double factor, std::vector<Vec3>& out);

double strain_energy_j(const TetSolid& solid, const SolidState::Field& moved_m,
                       const std::vector<Mat3>& turned);

}  // namespace osteon
