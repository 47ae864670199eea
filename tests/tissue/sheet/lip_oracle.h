#pragma once

// The plane balance of a cut sheet with a flat blade in its cut, assembled and solved otherwise
// than the program does: constant-strain triangles by B^T D B, Eigen's sparse factor, and vertices
// of the lip that are held at the blade's face as long as it pushes them.
#include <Eigen/Sparse>
#include <cmath>
#include <set>
#include <vector>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

class LipOracle {
 public:
  LipOracle(const SkinSheet& sheet, const SheetCuts& cuts) : split_(split(sheet, cuts)) {
    const SheetMaterial& m = sheet.material();
    const double c = m.stretch_n_per_m / (1 - m.poisson * m.poisson);
    Eigen::Matrix3d D;
    D << c, c * m.poisson, 0, c * m.poisson, c, 0, 0, 0, 0.5 * c * (1 - m.poisson);
    const auto n = static_cast<Eigen::Index>(2 * split_.vertex.size());
    load_ = Eigen::VectorXd::Zero(n);
    for (const Triangle& t : split_.triangles) {
      const SheetPoint p[3] = {split_.point[t[0]], split_.point[t[1]], split_.point[t[2]]};
      const SheetPoint u = p[1] - p[0], v = p[2] - p[0];
      const double area = 0.5 * (u.x() * v.y() - u.y() * v.x());
      Eigen::Matrix<double, 3, 6> B = Eigen::Matrix<double, 3, 6>::Zero();
      for (int a = 0; a < 3; ++a) {
        const SheetPoint &q = p[(a + 1) % 3], &r = p[(a + 2) % 3];
        const double bx = (q.y() - r.y()) / (2 * area), by = (r.x() - q.x()) / (2 * area);
        B(0, 2 * a) = B(2, 2 * a + 1) = bx;
        B(1, 2 * a + 1) = B(2, 2 * a) = by;
      }
      const Eigen::Matrix<double, 6, 6> K = area * B.transpose() * D * B;
      const Eigen::Matrix<double, 6, 1> tension =
          area * m.tension_n_per_m * B.transpose() * Eigen::Vector3d(1, 1, 0);
      for (int i = 0; i < 6; ++i) {
        const auto row = static_cast<Eigen::Index>(2 * t[static_cast<std::size_t>(i / 2)] + i % 2);
        load_[row] -= tension[i];
        terms_.emplace_back(row, row, area * m.tether_n_per_m3 / 3);
        for (int j = 0; j < 6; ++j)
          terms_.emplace_back(
              row, static_cast<Eigen::Index>(2 * t[static_cast<std::size_t>(j / 2)] + j % 2),
              K(i, j));
      }
    }
    for (std::size_t i = 0; i < split_.vertex.size(); ++i)
      if (sheet.is_rim(split_.vertex[i]))
        for (int d = 0; d < 2; ++d)
          terms_.emplace_back(static_cast<Eigen::Index>(2 * i + d),
                              static_cast<Eigen::Index>(2 * i + d), kHeld);
  }

  /// Of a slit along x: force along y on a blade of that half width whose face towards +y has come
  /// to `face_m`, in the middle of the slit.
  double force_n(double face_m, double half_m) {
    std::set<std::uint32_t> upper;  // copies of the lip that the blade can push
    for (const SheetWall& wall : split_.walls)
      if (split_.point[wall.to].x() > split_.point[wall.from].x())  // the skin is on its left
        for (const std::uint32_t copy : {wall.from, wall.to})
          if (std::abs(split_.point[copy].x()) <= half_m) upper.insert(copy);
    std::set<std::uint32_t> held = upper;
    for (int round = 0; round < 20; ++round) {
      const Eigen::VectorXd u = solve(held, face_m);
      std::set<std::uint32_t> next;
      for (const std::uint32_t copy : upper) {
        const double over = face_m - split_.point[copy].y() - u[2 * copy + 1];
        if (over > 0) next.insert(copy);
      }
      if (next == held || round == 19) {
        double sum = 0;
        for (const std::uint32_t copy : held)
          sum += kHeld * (face_m - split_.point[copy].y() - u[2 * copy + 1]);
        return sum;
      }
      held = next;
    }
    return 0;
  }

 private:
  static constexpr double kHeld = 1e9;
  Eigen::VectorXd solve(const std::set<std::uint32_t>& held, double face_m) const {
    auto terms = terms_;
    Eigen::VectorXd load = load_;
    for (const std::uint32_t copy : held) {
      const auto row = static_cast<Eigen::Index>(2 * copy + 1);
      terms.emplace_back(row, row, kHeld);
      load[row] += kHeld * (face_m - split_.point[copy].y());
    }
    Eigen::SparseMatrix<double> K(load.size(), load.size());
    K.setFromTriplets(terms.begin(), terms.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(load);
  }

  SplitSheet split_;
  std::vector<Eigen::Triplet<double>> terms_;
  Eigen::VectorXd load_;
};

}  // namespace osteon
