#include "tet/tet_precondition.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>

#include "tet/tet_element.h"
#include "tet/tet_factor.h"

namespace osteon {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

// Block of the stiffness between corners a and b of a linear element.
Mat3 block(const TetElement& e, std::size_t a, std::size_t b, double mu, double lambda) {
  Mat3 k = lambda * e.slope[a] * e.slope[b].transpose() + mu * e.slope[b] * e.slope[a].transpose();
  k.diagonal().array() += mu * e.slope[a].dot(e.slope[b]);
  return e.volume_m3 * k;
}

std::vector<double> corner_masses(const TetSolid& solid) {
  std::vector<double> mass(solid.corners, 0.0);
  for (const TetElement& e : solid.elements)
    for (std::size_t a = 0; a < 4; ++a)
      mass[e.node[a]] += 0.25 * solid.material.density_kg_per_m3 * e.volume_m3;
  return mass;
}

void add_block(Triplets& out, const AxisMask& held, std::uint32_t i, std::uint32_t j,
               const Mat3& k) {
  for (std::uint32_t p = 0; p < 3; ++p)
    for (std::uint32_t q = 0; q < 3; ++q)
      if (!held[i][p] && !held[j][q] && 3 * i + p >= 3 * j + q)
        out.emplace_back(3 * i + p, 3 * j + q, k(p, q));
}

Sparse corner_matrix(const TetSolid& solid, const AxisMask& held, const StepWeights& by) {
  const double mu = shear_modulus_pa(solid.material);
  const double lambda = bulk_modulus_pa(solid.material) - 2.0 / 3 * mu;
  Triplets all;
  all.reserve(solid.elements.size() * 78);
  for (const TetElement& e : solid.elements)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        add_block(all, held, e.node[a], e.node[b], by.stiffness * block(e, a, b, mu, lambda));
  const std::vector<double> mass = corner_masses(solid);
  for (std::uint32_t i = 0; i < solid.corners; ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      all.emplace_back(3 * i + k, 3 * i + k, held[i][k] ? 1 : by.mass * mass[i]);
  const auto size = static_cast<Eigen::Index>(3 * solid.corners);
  Sparse out(size, size);
  out.setFromTriplets(all.begin(), all.end());
  return out;
}

using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower>;

// Diagonal block of each node: stiffness of its own motion alone.
std::vector<Mat3> diagonal_blocks(const TetSolid& solid, const StepWeights& by) {
  const double mu = shear_modulus_pa(solid.material);
  const double lambda = bulk_modulus_pa(solid.material) - 2.0 / 3 * mu;
  const TetPoints& points = points_of(solid.order);
  std::vector<Mat3> out(solid.rest_W.size(), Mat3::Zero());
  for (const TetElement& e : solid.elements)
    for (std::size_t a = 0; a < solid.nodes_an_element(); ++a)
      for (std::size_t q = 0; q < points.count; ++q) {
        NodeVectors unit;
        unit.fill(Vec3::Zero());
        unit[a] = Vec3::UnitX();
        const CornerVectors w = slope_weights(solid.order, points.at[q], unit);
        Vec3 slope = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k) slope += w[k].x() * e.slope[k];
        Mat3 b = (lambda + mu) * slope * slope.transpose();
        b.diagonal().array() += mu * slope.squaredNorm();
        out[e.node[a]] += by.stiffness * e.volume_m3 / static_cast<double>(points.count) * b;
      }
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].diagonal().array() += by.mass * solid.mass_kg[i];
  return out;
}

void hold(Vec3& v, const std::array<bool, 3>& held) {
  for (std::size_t k = 0; k < 3; ++k)
    if (held[k]) v[static_cast<Eigen::Index>(k)] = 0;
}

/// Ends of the edge under each middle node.
std::vector<std::array<std::uint32_t, 2>> ends_of_middles(const TetSolid& solid) {
  std::vector<std::array<std::uint32_t, 2>> out(solid.rest_W.size() - solid.corners);
  if (out.empty()) return out;
  for (const TetElement& e : solid.elements)
    for (std::size_t k = 0; k < 6; ++k)
      out[e.node[4 + k] - solid.corners] = {e.node[kTetEdges[k][0]], e.node[kTetEdges[k][1]]};
  return out;
}

}  // namespace

struct TetPreconditioner::Impl {
  AxisMask held;
  std::size_t corners;
  std::vector<std::array<std::uint32_t, 2>> ends;
  std::vector<Mat3> inverse_blocks;  // quadratic elements only
  TetFactor factor;
};

TetPreconditioner::TetPreconditioner(const TetSolid& solid, const AxisMask& held,
                                     const StepWeights& weights)
    : impl_(std::make_unique<Impl>()) {
  impl_->held = held;
  impl_->corners = solid.corners;
  impl_->ends = ends_of_middles(solid);
  impl_->factor.compute(corner_matrix(solid, held, weights));
  if (solid.order == TetOrder::kLinear) return;
  impl_->inverse_blocks = diagonal_blocks(solid, weights);
  for (std::size_t i = 0; i < held.size(); ++i) {
    Mat3& b = impl_->inverse_blocks[i];
    for (Eigen::Index k = 0; k < 3; ++k)
      if (held[i][static_cast<std::size_t>(k)]) {
        b.row(k).setZero();
        b.col(k).setZero();
        b(k, k) = 1;
      }
    b = b.inverse().eval();
  }
}

TetPreconditioner::~TetPreconditioner() = default;

std::vector<Vec3> TetPreconditioner::solve(const std::vector<Vec3>& r,
                                           const std::vector<Mat3>& turned) const {
  const Impl& m = *impl_;
  std::vector<Vec3> back(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    back[i] = turned[i].transpose() * r[i];
    hold(back[i], m.held[i]);
  }
  Eigen::VectorXd coarse(static_cast<Eigen::Index>(3 * m.corners));
  for (std::size_t i = 0; i < m.corners; ++i)
    coarse.segment<3>(static_cast<Eigen::Index>(3 * i)) = back[i];
  for (std::size_t e = 0; e < m.ends.size(); ++e)
    for (const std::uint32_t c : m.ends[e])
      coarse.segment<3>(3 * static_cast<Eigen::Index>(c)) += 0.5 * back[m.corners + e];
  for (std::size_t i = 0; i < m.corners; ++i) {
    Vec3 at = coarse.segment<3>(static_cast<Eigen::Index>(3 * i));
    hold(at, m.held[i]);
    coarse.segment<3>(static_cast<Eigen::Index>(3 * i)) = at;
  }
  m.factor.solve(coarse);
  const Eigen::VectorXd& x = coarse;
  std::vector<Vec3> z(r.size());
  for (std::size_t i = 0; i < m.corners; ++i) z[i] = x.segment<3>(static_cast<Eigen::Index>(3 * i));
  for (std::size_t e = 0; e < m.ends.size(); ++e)
    z[m.corners + e] = 0.5 * (z[m.ends[e][0]] + z[m.ends[e][1]]);
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (!m.inverse_blocks.empty()) z[i] += m.inverse_blocks[i] * back[i];
    hold(z[i], m.held[i]);
    z[i] = turned[i] * z[i];
  }
  return z;
}

double slowest_swing(const TetSolid& solid, const AxisMask& held, double step_s) {
  constexpr int kRounds = 12;
  const StepWeights by{1, step_s * step_s};
  Factor factor(corner_matrix(solid, held, by));
  const std::vector<double> mass = corner_masses(solid);
  const auto size = static_cast<Eigen::Index>(3 * solid.corners);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(size), x = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < solid.corners; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!held[i][k]) {
        const auto at = static_cast<Eigen::Index>(3 * i + k);
        diagonal[at] = mass[i];
        x[at] = 1 + 0.3 * static_cast<double>((7 * i + 3 * k) % 11);
      }
  // A x = theta M x with A = M + dt^2 K: theta = 1 + (omega dt)^2, smallest for the slowest swing.
  double theta = 1;
  for (int n = 0; n < kRounds; ++n) {
    const Eigen::VectorXd mx = diagonal.cwiseProduct(x);
    const Eigen::VectorXd y = factor.solve(mx);
    theta = y.dot(mx) > 0 ? y.dot(mx) / y.dot(diagonal.cwiseProduct(y)) : 1;
    x = y / y.cwiseAbs().maxCoeff();
  }
  return std::sqrt(std::max(theta - 1, 0.0)) / step_s;
}

}  // namespace osteon
