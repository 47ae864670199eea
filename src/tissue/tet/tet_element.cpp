#include "tet/tet_element.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace osteon {
namespace {

/// Stress of a strain: 2 mu e + lambda tr(e).
struct Hooke {
  double mu, lambda;
  explicit Hooke(const SolidMaterial& m)
      : mu(shear_modulus_pa(m)), lambda(bulk_modulus_pa(m) - 2.0 / 3 * mu) {}
  Mat3 stress(const Mat3& e) const {
    Mat3 s = 2 * mu * e;
    s.diagonal().array() += lambda * e.trace();
    return s;
  }
};

Mat3 symmetric(const Mat3& m) { return 0.5 * (m + m.transpose()); }

NodeVectors gathered(const TetSolid& solid, const TetElement& e, const SolidState::Field& u) {
  NodeVectors out;
  for (std::size_t a = 0; a < solid.nodes_an_element(); ++a) {
    const std::uint32_t s = e.node[a];
    out[a] = Vec3(u[0][s], u[1][s], u[2][s]);
  }
  return out;
}

CornerVectors times_slopes(const Mat3& p, const TetElement& e, double factor) {
  CornerVectors w;
  for (std::size_t k = 0; k < 4; ++k) w[k] = factor * (p * e.slope[k]);
  return w;
}

void scatter(const TetSolid& solid, const TetElement& e, const NodeVectors& f,
             std::vector<Vec3>& out) {
  for (std::size_t a = 0; a < solid.nodes_an_element(); ++a) out[e.node[a]] += f[a];
}

NodeVectors nothing() {
  NodeVectors f;
  f.fill(Vec3::Zero());
  return f;
}

}  // namespace

Mat3 rotation_of(const Mat3& f) {
  constexpr int kMost = 20;  // ten suffice where no stretch is beyond a thousandfold
  if (!(f.determinant() > 1e-9)) {
    if (!f.allFinite()) return Mat3::Identity();
    const Eigen::JacobiSVD<Mat3> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
  }
  Mat3 r = f;
  for (int n = 0; n < kMost; ++n) {
    const Mat3 next = 0.5 * (r + r.inverse().transpose());
    const double change = (next - r).squaredNorm();
    r = next;
    if (change < 1e-28) break;
  }
  return r;
}

std::vector<Mat3> rotations(const TetSolid& solid, const SolidState::Field& moved_m) {
  const TetPoints& points = points_of(solid.order);
  std::vector<Mat3> out(solid.elements.size() * points.count, Mat3::Identity());
  if (!solid.corotated) return out;
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    const NodeVectors u = gathered(solid, e, moved_m);
    for (std::size_t q = 0; q < points.count; ++q)
      out[i * points.count + q] = rotation_of(
          Mat3::Identity() + gradient(e.slope, slope_weights(solid.order, points.at[q], u)));
  }
  return out;
}

void add_elastic(const TetSolid& solid, const SolidState::Field& moved_m,
                 const std::vector<Mat3>& turned, double factor, std::vector<Vec3>& force_n) {
  const Hooke hooke(solid.material);
  const TetPoints& points = points_of(solid.order);
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    const NodeVectors u = gathered(solid, e, moved_m);
    const double weight = -factor * e.volume_m3 / static_cast<double>(points.count);
    NodeVectors f = nothing();
    for (std::size_t q = 0; q < points.count; ++q) {
      const Mat3 h = gradient(e.slope, slope_weights(solid.order, points.at[q], u));
      const Mat3& turn = turned[i * points.count + q];
      // R^T (1 + grad u) - 1 as R^T grad u + (R^T - 1): no digits are lost where u is small.
      const Mat3 back = turn.transpose();
      const Mat3 p = turn * hooke.stress(symmetric(back * h + back - Mat3::Identity()));
      add_to_nodes(solid.order, points.at[q], times_slopes(p, e, weight), f);
    }
    scatter(solid, e, f, force_n);
  }
}

void add_stiffness(const TetSolid& solid, const std::vector<Mat3>& turned,
                   const std::vector<Vec3>& v, double factor, std::vector<Vec3>& out) {
  const Hooke hooke(solid.material);
  const TetPoints& points = points_of(solid.order);
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    NodeVectors u;
    for (std::size_t a = 0; a < solid.nodes_an_element(); ++a) u[a] = v[e.node[a]];
    const double weight = factor * e.volume_m3 / static_cast<double>(points.count);
    NodeVectors f = nothing();
    for (std::size_t q = 0; q < points.count; ++q) {
      const Mat3 h = gradient(e.slope, slope_weights(solid.order, points.at[q], u));
      const Mat3& turn = turned[i * points.count + q];
      const Mat3 p = solid.corotated ? Mat3(turn * hooke.stress(symmetric(turn.transpose() * h)))
                                     : hooke.stress(symmetric(h));
      add_to_nodes(solid.order, points.at[q], times_slopes(p, e, weight), f);
    }
    scatter(solid, e, f, out);
  }
}

double strain_energy_j(const TetSolid& solid, const SolidState::Field& moved_m,
                       const std::vector<Mat3>& turned) {
  const Hooke hooke(solid.material);
  const TetPoints& points = points_of(solid.order);
  double sum = 0;
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    const NodeVectors u = gathered(solid, e, moved_m);
    for (std::size_t q = 0; q < points.count; ++q) {
      const Mat3 h = gradient(e.slope, slope_weights(solid.order, points.at[q], u));
      const Mat3 back = turned[i * points.count + q].transpose();
      const Mat3 strain = symmetric(back * h + back - Mat3::Identity());
      sum += 0.5 * e.volume_m3 / static_cast<double>(points.count) *
             hooke.stress(strain).cwiseProduct(strain).sum();
    }
  }
  return sum;
}

}  // namespace osteon
