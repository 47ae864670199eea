#include "tet/tet_points.h"

namespace osteon {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double));
const double* numbers_of(std::span<const Vec3> v) { return v.data()->data(); }

std::size_t padded(std::size_t count) {
  constexpr auto wide = static_cast<std::size_t>(tets::kRegister);
  return (count + wide - 1) / wide * wide;
}

}  // namespace

TetPointRows::TetPointRows(const TetSolid& solid)
    : corotated_(solid.corotated), nodes_(solid.nodes_an_element()) {
  const TetPoints& points = points_of(solid.order);
  const double mu = shear_modulus_pa(solid.material), bulk = bulk_modulus_pa(solid.material);
  moduli_ = {mu, bulk - 2.0 / 3 * mu, bulk};
  count_ = solid.elements.size() * points.count;
  stride_ = padded(count_);
  node_.assign(nodes_ * stride_, 0);
  slope_.assign(3 * nodes_ * stride_, 0.0);
  volume_.assign(stride_, 0.0);
  first_.assign(solid.rest_W.size() + 1, 0);
  per_volume_.assign(solid.rest_W.size(), 0.0);
  for (std::size_t p = 0; p < count_; ++p) {
    const TetElement& e = solid.elements[p / points.count];
    volume_[p] = e.volume_m3 / static_cast<double>(points.count);
    for (std::size_t a = 0; a < nodes_; ++a) {
      NodeVectors unit;
      unit.fill(Vec3::Zero());
      unit[a] = Vec3::UnitX();
      const CornerVectors w = slope_weights(solid.order, points.at[p % points.count], unit);
      Vec3 slope = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) slope += w[k].x() * e.slope[k];
      node_[a * stride_ + p] = e.node[a];
      for (std::size_t k = 0; k < 3; ++k)
        slope_[(3 * a + k) * stride_ + p] = slope[static_cast<Eigen::Index>(k)];
      ++first_[e.node[a] + 1];
      per_volume_[e.node[a]] += volume_[p];
    }
  }
  for (double& v : per_volume_) v = 1 / v;
  for (std::size_t n = 0; n + 1 < first_.size(); ++n) first_[n + 1] += first_[n];
  at_.resize(nodes_ * count_);
  point_.resize(nodes_ * count_);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t p = 0; p < count_; ++p)
    for (std::size_t a = 0; a < nodes_; ++a) {
      const std::uint32_t to = next[node_[a * stride_ + p]]++;
      at_[to] = static_cast<std::uint32_t>(3 * a * stride_ + p);
      point_[to] = static_cast<std::uint32_t>(p);
    }
}

tets::TetRows TetPointRows::rows(TetPointScratch& scratch) const {
  scratch.force.resize(3 * nodes_ * stride_);
  if (corotated_) scratch.turn.resize(9 * stride_);
  return {node_.data(),
          slope_.data(),
          volume_.data(),
          scratch.turn.empty() ? nullptr : scratch.turn.data(),
          scratch.force.data(),
          static_cast<long>(nodes_),
          static_cast<long>(count_),
          static_cast<long>(stride_)};
}

// Sums in the order of the points, whatever registers reckoned them.
void TetPointRows::gather(const TetPointScratch& scratch, std::span<Vec3> out) const {
  const double* force = scratch.force.data();
  for (std::size_t n = 0; n < out.size(); ++n) {
    double x = out[n].x(), y = out[n].y(), z = out[n].z();
    for (std::uint32_t k = first_[n]; k < first_[n + 1]; ++k) {
      const double* f = force + at_[k];
      x += f[0];
      y += f[stride_];
      z += f[2 * stride_];
    }
    out[n] = {x, y, z};
  }
}

void TetPointRows::rotate(std::span<const Vec3> moved_m, TetPointScratch& scratch) const {
  if (!corotated_) return;
  const tets::TetRows r = rows(scratch);
  tets::best_tet_work().rotate(r, numbers_of(moved_m));
  for (std::size_t p = 0; p < count_; ++p) {
    if (scratch.turn[p] != 0 || scratch.turn[stride_ + p] != 0 ||
        scratch.turn[2 * stride_ + p] != 0)
      continue;  // a row of a rotation is never zero
    Mat3 f = Mat3::Identity();
    for (std::size_t a = 0; a < nodes_; ++a)
      for (Eigen::Index k = 0; k < 3; ++k)
        f.col(k) += slope_[(3 * a + static_cast<std::size_t>(k)) * stride_ + p] *
                    moved_m[node_[a * stride_ + p]];
    const Mat3 turn = rotation_of(f);
    for (std::size_t k = 0; k < 9; ++k)
      scratch.turn[k * stride_ + p] =
          turn(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
  }
}

void TetPointRows::add_elastic(std::span<const Vec3> moved_m, TetPointScratch& scratch,
                               std::span<Vec3> force_n) const {
  tets::best_tet_work().elastic(rows(scratch), moduli_, numbers_of(moved_m), 1);
  gather(scratch, force_n);
}

void TetPointRows::add_stiffness(std::span<const Vec3> v, double factor, TetPointScratch& scratch,
                                 std::span<Vec3> out) const {
  tets::best_tet_work().stiffness(rows(scratch), moduli_, numbers_of(v), factor);
  gather(scratch, out);
}

void TetPointRows::add_neo_hookean(std::span<const Vec3> moved_m, TetPointScratch& scratch,
                                   std::span<Vec3> force_n) const {
  tets::best_tet_work().neo_hookean(rows(scratch), moduli_, numbers_of(moved_m));
  gather(scratch, force_n);
}

std::vector<Mat3> TetPointRows::node_rotations(const TetPointScratch& scratch) const {
  const std::size_t nodes = per_volume_.size(), wide = padded(nodes);
  std::vector<Mat3> out(nodes, Mat3::Identity());
  if (!corotated_) return out;
  std::vector<double> mean(9 * wide, 0.0);
  for (std::size_t n = 0; n < nodes; ++n) {
    double sum[9] = {};
    for (std::uint32_t k = first_[n]; k < first_[n + 1]; ++k) {
      const double volume = volume_[point_[k]];
      const double* turn = scratch.turn.data() + point_[k];
      for (std::size_t m = 0; m < 9; ++m) sum[m] += volume * turn[m * stride_];
    }
    for (std::size_t m = 0; m < 9; ++m) {
      mean[m * wide + n] = per_volume_[n] * sum[m];
      out[n](static_cast<Eigen::Index>(m / 3), static_cast<Eigen::Index>(m % 3)) =
          mean[m * wide + n];
    }
  }
  tets::best_tet_work().nearest(mean.data(), static_cast<long>(nodes), static_cast<long>(wide));
  for (std::size_t n = 0; n < nodes; ++n) {
    if (mean[n] == 0 && mean[wide + n] == 0 && mean[2 * wide + n] == 0) {
      out[n] = rotation_of(out[n]);
      continue;
    }
    for (std::size_t m = 0; m < 9; ++m)
      out[n](static_cast<Eigen::Index>(m / 3), static_cast<Eigen::Index>(m % 3)) =
          mean[m * wide + n];
  }
  return out;
}

}  // namespace osteon
