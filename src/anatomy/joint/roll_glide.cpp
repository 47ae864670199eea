#include "joint/roll_glide.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "bone/nearby_surface.h"
#include "finding/displace.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

constexpr double kClose_m = 1e-6;  // that a gap or a tendon's length is met to
constexpr int kMostRounds = 60;
constexpr double kReach_m = 0.004;  // farther than the nearest by this, a point is not looked at

/// Points of a moved bone that face a fixed surface.
class Facet {
 public:
  /// Vertices of the bone that the layer covers.
  Facet(const TriMesh& mesh_W, const SoftDescription& soft) {
    Solid region;
    for (const BoundPart& part : std::get<LayerDescription>(soft.shape).region)
      region.parts.push_back(part.part);
    for (const Vec3& v : mesh_W.vertices)
      if (!region.parts.empty() && distance(region, v) < 0) points_.push_back(v);
  }
  bool empty() const { return points_.empty(); }

  struct Nearest {
    double gap = 1e300;
    Vec3 away_W = Vec3::UnitX();  ///< unit, from the surface to the point
    std::size_t point = 0;
  };
  /// Of the points moved by X, those of `among`.
  Nearest nearest(const MeshDistance& surface, const Pose& X,
                  const std::vector<std::size_t>& among) const {
    Nearest best;
    NearbySurface nearby(surface, {});
    for (const std::size_t i : among) {
      const Vec3 p_W = X * points_[i];
      const auto at = nearby.nearer_than(best.gap, p_W);
      if (!at || at->signed_distance >= best.gap) continue;
      const Vec3 away = p_W - at->point;
      const double length = away.norm();
      const double sign = at->signed_distance < 0 ? -1 : 1;
      best = {at->signed_distance, length > 1e-12 ? Vec3((sign / length) * away) : best.away_W, i};
    }
    return best;
  }
  /// Those that may be the nearest while the bone moves by little.
  std::vector<std::size_t> candidates(const MeshDistance& surface, const Pose& X) const {
    std::vector<double> gaps;
    double least = 1e300;
    NearbySurface nearby(surface, {});
    for (const Vec3& p : points_) {
      const auto at = nearby.nearer_than(least + kReach_m, X * p);
      gaps.push_back(at ? at->signed_distance : 1e300);
      least = std::min(least, gaps.back());
    }
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < gaps.size(); ++i)
      if (gaps[i] < least + kReach_m) near.push_back(i);
    return near;
  }
  double gap_at_rest(const MeshDistance& surface) const {
    return nearest(surface, {}, candidates(surface, {})).gap;
  }

 private:
  std::vector<Vec3> points_;  ///< in World at rest
};

/// What is free of the moved bone's pose: how far its plateaus have gone from the condyles, and its
/// tilt about World z.
struct Seat {
  double down = 0;  ///< metres along the bone
  double tilt_deg = 0;
};

/// The pose that puts the condyles where row `k` says, with the moved bone seated so.
Pose pose_of_row(const RollingJoint& joint, std::size_t k, const Seat& seat) {
  const double bend_deg = joint.step_deg * static_cast<double>(k);
  const Mat3 bend = rotation_xyz_deg({0, bend_deg, 0});
  const Mat3 tilt = rotation_xyz_deg({0, 0, seat.tilt_deg});
  const Mat3 inward = rotation_xyz_deg({-joint.inward_deg[k], 0, 0});
  const Mat3 R = bend * tilt * inward;
  const Vec3 middle_W = 0.5 * (joint.medial.p_W + joint.lateral.p_W);
  const Vec3 to_medial = R.transpose() * (joint.medial.p_W - middle_W);
  // The middle between the centres, seen from the moved bone.
  Vec3 seen = middle_W;
  seen.x() -= seat.down;
  seen.z() = joint.medial.p_W.z() - joint.back[k] - to_medial.z();
  return {middle_W - R * seen, Quat(R)};
}

/// Seats the moved bone so that both plateaus keep the gaps that they have at rest.
class Seater {
 public:
  Seater(const RollingJoint& joint, const MeshDistance& fixed, const Facet& medial,
         const Facet& lateral)
      : joint_(joint),
        fixed_(fixed),
        medial_(medial),
        lateral_(lateral),
        medial_gap_(medial.gap_at_rest(fixed)),
        lateral_gap_(lateral.gap_at_rest(fixed)),
        apart_((joint.medial.p_W - joint.lateral.p_W).norm()) {}

  /// Goes on from the seat of the row before. Unknowns: `down` and `tilt_deg`, of which each
  /// plateau's gap changes by 1 and by half of `apart_` a radian: Newton's method with that fixed
  /// slope. Invariant: the condyles' centres stand where row k puts them, whatever the seat. Ends:
  /// with both gaps right to kClose_m, or with an error after kMostRounds.
  Result<Pose> seat_row(std::size_t k, Seat& seat) const {
    if (k == 0) return Pose{};
    constexpr double kDegrees = 180 / 3.14159265358979323846;
    for (int round = 0; round < kMostRounds; ++round) {
      const Pose X = pose_of_row(joint_, k, seat);
      if (round % 8 == 0) look_near(X);
      const double medial = medial_gap_ - medial_.nearest(fixed_, X, near_medial_).gap;
      const double lateral = lateral_gap_ - lateral_.nearest(fixed_, X, near_lateral_).gap;
      if (std::max(std::abs(medial), std::abs(lateral)) < kClose_m && round % 8 != 0) return X;
      seat.down += 0.5 * (medial + lateral);
      seat.tilt_deg -= kDegrees * (medial - lateral) / apart_;
    }
    return fail("finds no contact for the moved bone at " +
                std::to_string(joint_.step_deg * static_cast<double>(k)) + " degrees");
  }

 private:
  void look_near(const Pose& X) const {
    near_medial_ = medial_.candidates(fixed_, X);
    near_lateral_ = lateral_.candidates(fixed_, X);
  }

  const RollingJoint& joint_;
  const MeshDistance& fixed_;
  const Facet& medial_;
  const Facet& lateral_;
  double medial_gap_, lateral_gap_, apart_;
  mutable std::vector<std::size_t> near_medial_, near_lateral_;
};

/// Draws the gliding bone along its groove.
class Glider {
 public:
  Glider(const GlidingBone& glides, const MeshDistance& fixed, const Facet& facet, const Vec3& from,
         const Vec3& to)
      : glides_(glides),
        fixed_(fixed),
        facet_(facet),
        from_W_(from),
        to_W_(to),
        gap_(facet.gap_at_rest(fixed)),
        length_((to - from).norm()) {}

  /// `X` holds the pose of the row before and gets that of row k; `moved`: of the tendon's far end.
  /// Unknowns: x and z of the bone's place; n is the direction of the gap, u that of the tendon.
  /// Newton's method on gap and tendon's length, no step longer than 6 mm. Ends: with both right to
  /// kClose_m, or with an error after kMostRounds or where n and u are nearly parallel.
  Result<void> glide_row(std::size_t k, const Pose& moved, Pose& X) const {
    if (k == 0) return {};
    const Quat before = X.q;
    X.q = Quat(rotation_xyz_deg({0, glides_.turn_deg[k], 0}));
    X.p += before * from_W_ - X.q * from_W_;  // turned about the tendon's end
    const Vec3 end_W = moved * to_W_;
    std::vector<std::size_t> near;
    for (int round = 0; round < kMostRounds; ++round) {
      if (round % 8 == 0) near = facet_.candidates(fixed_, X);
      const Facet::Nearest at = facet_.nearest(fixed_, X, near);
      const Vec3 along = X * from_W_ - end_W;
      const double gap = gap_ - at.gap, length = length_ - along.norm();
      if (std::max(std::abs(gap), std::abs(length)) < kClose_m && round % 8 != 0) return {};
      // In the plane of the bend: n . step = gap and u . step = length.
      const Vec3 u = along / along.norm(), n = at.away_W;
      const double det = n.x() * u.z() - n.z() * u.x();
      if (std::abs(det) < 0.05) break;
      Vec3 step((gap * u.z() - length * n.z()) / det, 0, (length * n.x() - gap * u.x()) / det);
      const double far = step.norm(), most = 0.006;
      X.p += far > most ? Vec3(step * (most / far)) : step;
    }
    return fail("finds no position for the gliding bone at row " + std::to_string(k));
  }

 private:
  const GlidingBone& glides_;
  const MeshDistance& fixed_;
  const Facet& facet_;
  Vec3 from_W_, to_W_;  ///< the tendon's ends, on their bones at rest
  double gap_, length_;
};

/// The tendon's ends as they are laid on their bones.
std::pair<Vec3, Vec3> ends_of(const BandDescription& band, const PlacedBones& bones) {
  const auto on = [&](const BandPoint& p) {
    return bones.surface_W(p.at.bone).closest(p.at.p_W).point;
  };
  return {on(band.path.front()), on(band.path.back())};
}

Result<void> add_gliding(const AnatomyDescription& anatomy, const RollingJoint& joint,
                         const PlacedBones& bones, JointMotion& motion) {
  const GlidingBone& glides = *joint.glides;
  const Facet facet(bones.surface_W(glides.bone).mesh(), anatomy.softs[glides.cartilage]);
  if (facet.empty()) return fail("its gliding cartilage covers nothing of the bone");
  const auto& band = std::get<BandDescription>(anatomy.softs[glides.tendon].shape);
  const auto [from_W, to_W] = ends_of(band, bones);
  const Glider glider(glides, bones.surface_W(joint.fixed), facet, from_W, to_W);
  PoseTrack track{0, joint.step_deg, {}};
  Pose X;
  for (std::size_t k = 0; k < joint.inward_deg.size(); ++k) {
    if (auto ok = glider.glide_row(k, motion[0].second.poses[k], X); !ok) return ok;
    track.poses.push_back(X);
  }
  motion.emplace_back(glides.bone, std::move(track));
  return {};
}

GeneratedJoint keep_motion(const AnatomyDescription& anatomy, const RollingJoint& joint,
                           const JointMotion& motion, const GeneratedAnatomy& at_rest) {
  GeneratedJoint kept{joint.name, anatomy.bones[joint.fixed].name, joint.at_deg, {}};
  const Pose X_FW = at_rest.bones[joint.fixed].X_WB.inverse();
  for (const auto& [bone, track_W] : motion) {
    PoseTrack track = track_W;
    for (Pose& X : track.poses) X = X_FW * (X * at_rest.bones[bone].X_WB);
    kept.bones.push_back({anatomy.bones[bone].name, std::move(track)});
  }
  return kept;
}

void bend(const JointMotion& motion, const RollingJoint& joint, AnatomyDescription& anatomy) {
  for (const auto& [bone, track] : motion) {
    const Pose D_W = pose_at(track, joint.at_deg);
    Displacement bent;
    bent.bones = {bone};
    bent.R_W = D_W.q.toRotationMatrix();
    bent.shift_W = D_W.p;
    bent.pivot = {joint.fixed, Vec3::Zero()};
    bent.by_joint = true;
    anatomy.displacements.push_back(std::move(bent));
  }
}

}  // namespace

Result<JointMotion> roll_and_glide(const AnatomyDescription& anatomy, const RollingJoint& joint,
                                   const PlacedBones& at_rest) {
  const TriMesh& moved = at_rest.surface_W(joint.moves[0]).mesh();
  const Facet medial(moved, anatomy.softs[joint.medial_plateau]);
  const Facet lateral(moved, anatomy.softs[joint.lateral_plateau]);
  if (medial.empty() || lateral.empty()) return fail("a plateau's cartilage covers nothing of it");
  const Seater seater(joint, at_rest.surface_W(joint.fixed), medial, lateral);
  PoseTrack track{0, joint.step_deg, {}};
  Seat seat;
  for (std::size_t k = 0; k < joint.inward_deg.size(); ++k) {
    auto X = seater.seat_row(k, seat);
    if (!X) return tl::unexpected(X.error());
    track.poses.push_back(*X);
  }
  JointMotion motion;
  for (const std::size_t bone : joint.moves) motion.emplace_back(bone, track);
  if (joint.glides)
    if (auto ok = add_gliding(anatomy, joint, at_rest, motion); !ok)
      return tl::unexpected(ok.error());
  return motion;
}

Result<void> bend_joints(AnatomyDescription& anatomy, const std::string& file,
                         const PlacedBones& placed, GeneratedAnatomy& grown) {
  for (const RollingJoint& joint : anatomy.joints) {
    const auto motion = roll_and_glide(anatomy, joint, placed);
    if (!motion)
      return fail(motion.error().what, file + ": joint '" + joint.name + "'",
                  "Choose values closer to the means");
    grown.joints.push_back(keep_motion(anatomy, joint, *motion, grown));
    if (joint.at_deg != 0) bend(*motion, joint, anatomy);
  }
  for (std::size_t i = 0; i < grown.bones.size(); ++i)
    if (const auto bent = bend_of(anatomy, i)) grown.bones[i].X_WB = *bent * grown.bones[i].X_WB;
  for (std::size_t i = 0; i < anatomy.landmarks.size(); ++i) {
    const LandmarkDescription& landmark = anatomy.landmarks[i];
    const auto bent = landmark.bone ? bend_of(anatomy, *landmark.bone) : std::nullopt;
    if (landmark.along)
      grown.landmarks[i].p_W = moved_beside_band(anatomy, landmark);
    else if (bent)
      grown.landmarks[i].p_W = *bent * grown.landmarks[i].p_W;
  }
  return {};
}

}  // namespace osteon
