#include "finding/displace.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "vary/vary_bound.h"

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

std::optional<Pose> total_of(const AnatomyDescription& anatomy, std::size_t bone,
                             bool joints_alone) {
  std::optional<Pose> total;
  for (const Displacement& d : anatomy.displacements) {
    if (joints_alone && !d.by_joint) continue;
    if (std::find(d.bones.begin(), d.bones.end(), bone) != d.bones.end())
      total = total ? pose_of(d) * *total : pose_of(d);
  }
  return total;
}

/// Half of the turns of both.
Quat mean_turn(const Quat& a, const Quat& b) {
  const Eigen::Vector4d to =
      a.coeffs().dot(b.coeffs()) < 0 ? Eigen::Vector4d(-b.coeffs()) : Eigen::Vector4d(b.coeffs());
  const Eigen::Vector4d sum = a.coeffs() + to;
  Quat mean;
  mean.coeffs() = sum / sum.norm();
  return mean;
}

/// The least turn from one direction to another less than a half turn away; unit vectors.
Quat turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  Quat turn(1 + from.dot(to), axis.x(), axis.y(), axis.z());
  turn.coeffs() /= turn.coeffs().norm();
  return turn;
}

/// A band's ends, by the motions of their bones.
struct MovedChord {
  Vec3 from, to;
  Pose of_from, of_to;

  /// How far along the way at rest a place beside it is, 0 to 1.
  double share_beside(const Vec3& near_W) const {
    const Vec3 way = to - from;
    return std::clamp((near_W - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  }

  /// Takes the straight way between the ends to where it comes, and what lies beside `near_W` with
  /// it.
  Pose motion_beside(const Vec3& near_W) const {
    const Vec3 way = to - from, moved_from = of_from * from, moved_way = of_to * to - moved_from;
    const double share = share_beside(near_W);
    const Quat mean = mean_turn(of_from.q, of_to.q);
    Pose X;
    X.q = turn_between(mean * (way / way.norm()), moved_way / moved_way.norm()) * mean;
    X.p = moved_from + share * moved_way - X.q * (from + share * way);
    return X;
  }
};

using Displaced = std::vector<std::optional<Pose>>;

Displaced displaced_bones(const AnatomyDescription& anatomy) {
  Displaced out;
  for (std::size_t i = 0; i < anatomy.bones.size(); ++i) out.push_back(displacement_of(anatomy, i));
  return out;
}

MovedChord chord_of(const BandDescription& band, const Displaced& displaced) {
  const BoundPoint &from = band.path.front().at, &to = band.path.back().at;
  return {from.p_W, to.p_W, displaced[from.bone].value_or(Pose{}),
          displaced[to.bone].value_or(Pose{})};
}

/// Parts of volumes and of the skin that go along with bands, with their primitives moved.
std::vector<std::pair<Part*, Primitive>> moved_along_bands(AnatomyDescription& anatomy,
                                                           const Displaced& displaced) {
  std::vector<std::pair<Part*, Primitive>> moved;
  const auto follow = [&](BoundPart& bound, const BandDescription& band) {
    const BoundPoint &from = band.path.front().at, &to = band.path.back().at;
    if (!displaced[from.bone] && !displaced[to.bone]) return;
    Primitive part = bound.part.primitive;
    move_rigidly(chord_of(band, displaced).motion_beside(bounds(part).center()), part);
    moved.emplace_back(&bound.part, std::move(part));
  };
  for (SoftDescription& soft : anatomy.softs) {
    std::vector<BoundPart>* parts = nullptr;
    if (auto* volume = std::get_if<VolumeDescription>(&soft.shape)) parts = &volume->parts;
    if (auto* skin = std::get_if<SkinDescription>(&soft.shape)) parts = &skin->parts;
    if (!parts) continue;
    for (BoundPart& bound : *parts)
      for (const SoftDescription& other : anatomy.softs)
        if (const auto* band = std::get_if<BandDescription>(&other.shape))
          if (other.name == bound.along) follow(bound, *band);
  }
  return moved;
}

}  // namespace

void move_rigidly(const Pose& X, Primitive& primitive) {
  const Mat3 R = X.q.toRotationMatrix();
  std::visit(RigidMover{R, X.p}, primitive);
}

Pose rest_pose(const BoneDescription& bone) { return {bone.p_WB, Quat(bone.R_WB)}; }

std::optional<Pose> displacement_of(const AnatomyDescription& anatomy, std::size_t bone) {
  return total_of(anatomy, bone, false);
}

std::optional<Pose> bend_of(const AnatomyDescription& anatomy, std::size_t bone) {
  return total_of(anatomy, bone, true);
}

Vec3 moved_beside_band(const AnatomyDescription& anatomy, const LandmarkDescription& landmark) {
  const auto& band = std::get<BandDescription>(anatomy.softs[*landmark.along].shape);
  const Displaced displaced = displaced_bones(anatomy);
  const MovedChord chord = chord_of(band, displaced);
  const double share = chord.share_beside(landmark.p_W);
  const Vec3 at_rest = chord.from + share * (chord.to - chord.from);
  const Vec3 from = chord.of_from * chord.from;
  const Vec3 now = from + share * (chord.of_to * chord.to - from);
  return now + displaced[*landmark.bone].value_or(Pose{}).rotate(landmark.p_W - at_rest);
}

void move_bound_along(AnatomyDescription& anatomy) {
  // All are known before any is moved: pivots move along too.
  const Displaced displaced = displaced_bones(anatomy);
  auto along = moved_along_bands(anatomy, displaced);
  for (std::size_t i = 0; i < anatomy.bones.size(); ++i) {
    const auto& moved = displaced[i];
    if (!moved) continue;
    move_bound(anatomy, {anatomy.bones[i].name},
               {[&](const Vec3& p_W) { return *moved * p_W; },
                [&](Primitive& part) { move_rigidly(*moved, part); }});
  }
  for (auto& [part, moved] : along) part->primitive = std::move(moved);
}

}  // namespace osteon
