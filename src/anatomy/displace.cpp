#include "displace.h"

#include <algorithm>

#include "vary_bound.h"

namespace osteon {
namespace {

/// Moves a primitive of World rigidly.
struct RigidMover {
  const Mat3& R;
  const Vec3& p;

  Vec3 moved(const Vec3& v) const { return R * v + p; }
  void operator()(Ellipsoid& e) const {
    e.center = moved(e.center);
    e.R_local = e.R_local * R.transpose();
  }
  void operator()(RoundedBox& b) const {
    b.center = moved(b.center);
    b.R_local = b.R_local * R.transpose();
  }
  void operator()(HalfSpace& h) const {
    h.point = moved(h.point);
    h.normal = R * h.normal;
  }
  void operator()(Crack& c) const {
    c.point = moved(c.point);
    c.normal = R * c.normal;
  }
  void operator()(Tube& t) const {
    for (Vec3& v : t.points) v = moved(v);
    find_reach(t);
  }
};

Pose pose_of(const Displacement& d) {
  return {d.pivot.p_W + d.shift_W - d.R_W * d.pivot.p_W, Quat(d.R_W)};
}

}  // namespace

Pose rest_pose(const BoneDescription& bone) { return {bone.p_WB, Quat(bone.R_WB)}; }

std::optional<Pose> displacement_of(const AnatomyDescription& anatomy, std::size_t bone) {
  std::optional<Pose> total;
  for (const Displacement& d : anatomy.displacements)
    if (std::find(d.bones.begin(), d.bones.end(), bone) != d.bones.end())
      total = total ? pose_of(d) * *total : pose_of(d);
  return total;
}

void move_bound_along(AnatomyDescription& anatomy) {
  for (std::size_t i = 0; i < anatomy.bones.size(); ++i) {
    const auto moved = displacement_of(anatomy, i);
    if (!moved) continue;
    const Mat3 R = moved->q.toRotationMatrix();
    const RigidMover mover{R, moved->p};
    move_bound(anatomy, {anatomy.bones[i].name},
               {[&](const Vec3& p_W) { return *moved * p_W; },
                [&](Primitive& part) { std::visit(mover, part); }});
  }
}

}  // namespace osteon
