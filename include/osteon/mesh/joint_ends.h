#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// The two ends of a long bone, where its joints are. An end is as long as the bone is wide there,
/// the rule of squares by which fractures of long bones are told apart (Mueller et al., "The
/// comprehensive classification of fractures of long bones", 1990). A body less than three times
/// as long as its ends are wide is all end.
class JointEnds {
 public:
  explicit JointEnds(const TriMesh& mesh);

  bool has_shaft() const { return has_shaft_; }
  bool on_shaft(const Vec3& p) const {
    const double s = axis_.dot(p);
    return has_shaft_ && s > low_ && s < high_;
  }

 private:
  Vec3 axis_ = Vec3::UnitZ();
  double low_ = 0, high_ = 0;  ///< along the axis: where the shaft starts and ends, m
  bool has_shaft_ = false;
};

}  // namespace osteon
