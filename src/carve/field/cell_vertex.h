#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Gathers points of the surface with their normals and finds where their planes meet.
class CellVertex {
 public:
  void add(const Vec3& point, const Vec3& normal);
  /// On a rim where the planes meet (least sum of squared distances, held near the points' mean
  /// where the planes say little), elsewhere half way there from that mean; inside the unit cell.
  Vec3 place() const;
  /// Mean of the normals, unit.
  Vec3 normal() const;
  /// Whether the planes turn sharply: a rim runs through the cell.
  bool on_rim() const;

 private:
  Mat3 spread_ = Mat3::Zero();  ///< sum of n n^T
  Vec3 pull_ = Vec3::Zero();    ///< sum of n (n . p)
  Vec3 points_ = Vec3::Zero(), normals_ = Vec3::Zero();
  int count_ = 0;
};

}  // namespace osteon
