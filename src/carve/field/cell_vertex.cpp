#include "field/cell_vertex.h"

#include <cmath>

namespace osteon {

void CellVertex::add(const Vec3& point, const Vec3& normal) {
  spread_ += normal * normal.transpose();
  pull_ += normal * normal.dot(point);
  points_ += point;
  normals_ += normal;
  ++count_;
}

// Minimises sum (n . (x - p))^2 + w |x - m|^2 over x, m being the points' mean: the second term
// makes the matrix regular and is small beside the first in every direction that a rim fixes.
Vec3 CellVertex::place() const {
  constexpr double kHold = 0.03;
  constexpr double kOff = 0.002;  // from the cell's faces: vertices of two cells never meet
  const Vec3 mean = points_ / count_;
  const Mat3 a = spread_ + kHold * count_ * Mat3::Identity();
  const Vec3 b = pull_ - spread_ * mean;
  // By the cofactors: `a` is symmetric and its eigenvalues are at least kHold * count.
  const Vec3 r0 = a.col(1).cross(a.col(2)), r1 = a.col(2).cross(a.col(0));
  const Vec3 r2 = a.col(0).cross(a.col(1));
  const double det = a.col(0).dot(r0);
  const Vec3 off = Vec3(r0.dot(b), r1.dot(b), r2.dot(b)) / det;
  // On a smooth face the planes meet as far outside of it as the points' mean lies within: half way
  // the mesh encloses the right volume.
  const Vec3 x = mean + (on_rim() ? 1.0 : 0.5) * off;
  return x.cwiseMax(kOff).cwiseMin(1 - kOff);
}

Vec3 CellVertex::normal() const {
  const double length = normals_.norm();
  return length > 0 ? Vec3(normals_ / length) : Vec3(Vec3::UnitZ());
}

bool CellVertex::on_rim() const {
  constexpr double kTurned = 0.93;  // mean length of normals that differ by 43 degrees
  return normals_.norm() < kTurned * count_;
}

}  // namespace osteon
