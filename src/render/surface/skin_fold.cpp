#include "surface/skin_fold.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

namespace osteon {
namespace {

constexpr double kFrom_rad = 0.7, kFull_rad = 2.0;  // bent so far
constexpr double kDeep_m = 0.016, kHalf_m = 0.0085;
constexpr double kSwell_m = 0.004, kSwellAt_m = 0.019, kSwellHalf_m = 0.011;
constexpr double kBehind_m = 0.025;  // the middle of the joint: nearer there is no flesh to fold
constexpr double kWholly_m = 0.035;
constexpr double kFacesBack = 0.5;  // cosine
constexpr double kMiddle_m = 0.010, kHollow_m = 0.045;
constexpr double kLeastOpen = 0.35;

double eased(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A long bone, from its end at the joint.
struct Shaft {
  Vec3 end = Vec3::Zero(), way = Vec3::UnitX();  ///< in World; unit
};

struct LongBone {
  Vec3 middle = Vec3::Zero(), along = Vec3::UnitX();  ///< unit
  double half_m = 0;
};

std::optional<LongBone> long_bone(const Case& the_case, const char* name) {
  const BoneId id = the_case.find(name);
  if (!id.valid() || the_case.bone(id).mesh.vertices.empty()) return {};
  const Bone& bone = the_case.bone(id);
  const double share = 1 / static_cast<double>(bone.mesh.vertices.size());
  LongBone out;
  for (const Vec3& v : bone.mesh.vertices) out.middle += share * (bone.X_WB * v);
  Mat3 spread = Mat3::Zero();
  for (const Vec3& v : bone.mesh.vertices) {
    const Vec3 from = bone.X_WB * v - out.middle;
    spread += share * from * from.transpose();
  }
  if (!spread.allFinite()) return {};
  out.along = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
  double least = 0, most = 0;
  for (const Vec3& v : bone.mesh.vertices) {
    const double at = out.along.dot(bone.X_WB * v - out.middle);
    least = std::min(least, at);
    most = std::max(most, at);
  }
  out.middle += 0.5 * (least + most) * out.along;
  out.half_m = 0.5 * (most - least);
  return out;
}

Shaft from_joint(const LongBone& bone, const Vec3& other_W) {
  const Vec3 a = bone.middle - bone.half_m * bone.along, b = bone.middle + bone.half_m * bone.along;
  return (a - other_W).norm() < (b - other_W).norm() ? Shaft{a, bone.along} : Shaft{b, -bone.along};
}

/// A knee as it was made.
struct BentKnee {
  Vec3 middle = Vec3::Zero(), towards_lower = Vec3::UnitX(), forwards = Vec3::UnitZ();  ///< unit
  double bent_rad = 0;
};

std::optional<BentKnee> bent_knee(const Case& the_case) {
  const auto femur = long_bone(the_case, "femur"), tibia = long_bone(the_case, "tibia");
  if (!femur || !tibia) return {};
  const Shaft up = from_joint(*femur, tibia->middle), down = from_joint(*tibia, femur->middle);
  const Vec3 back = up.way + down.way, across = down.way - up.way;
  BentKnee out;
  out.bent_rad = 2 * std::asin(std::min(0.5 * back.norm(), 1.0));
  if (out.bent_rad <= kFrom_rad || !(across.norm() > 0.05)) return {};
  out.middle = 0.5 * (up.end + down.end);
  out.towards_lower = across.normalized();
  out.forwards = -back.normalized();
  return out;
}

/// In the frame of the hollow: along the limb, forwards and to a side, from the joint's middle.
class Hollow {
 public:
  Hollow(const BentKnee& knee, const Surface& skin)
      : knee_(knee), side_(knee.towards_lower.cross(knee.forwards)) {
    double deepest = -1;  // nearest to the joint, of what lies behind it
    for (std::size_t k = 0; k < skin.points.size(); ++k) {
      const Vec3 at = place(skin.points[k]);
      if (skin.normals[k].dot(knee.forwards) > -kFacesBack) continue;
      const bool in_middle = std::abs(at.z()) < kMiddle_m && std::abs(at.x()) < kHollow_m;
      if (!in_middle || at.y() > 0 || at.y() <= deepest) continue;
      deepest = at.y();
      fold_at_ = at.x();
    }
    if (deepest > -kBehind_m) fold_at_.reset();
  }
  bool found() const { return fold_at_.has_value(); }
  /// How far skin moves there: forwards into the fold, and out along its normal beside it.
  Vec3 shift(const Vec3& p, const Vec3& normal) const {
    const Vec3 at = place(p);
    const double strength = eased(kFrom_rad, kFull_rad, knee_.bent_rad) *
                            eased(kBehind_m, kWholly_m, -at.y()) *
                            eased(-0.15, 0.45, -normal.dot(knee_.forwards));
    const double away = (at.x() - *fold_at_) / kHalf_m;
    const double beside = (std::abs(at.x() - *fold_at_) - kSwellAt_m) / kSwellHalf_m;
    return strength * (kDeep_m * std::exp(-away * away) * knee_.forwards +
                       kSwell_m * std::exp(-beside * beside) * normal);
  }

 private:
  Vec3 place(const Vec3& p) const {
    const Vec3 from = p - knee_.middle;
    return {knee_.towards_lower.dot(from), knee_.forwards.dot(from), side_.dot(from)};
  }

  const BentKnee& knee_;
  Vec3 side_;
  std::optional<double> fold_at_;  ///< along the limb: where the hollow is deepest
};

}  // namespace

std::vector<ShadedMesh::Root> find_fold(const Case& the_case, const Surface& skin) {
  constexpr double kSeen_m = 1e-5;
  const auto knee = bent_knee(the_case);
  std::vector<ShadedMesh::Root> fold;
  if (!knee) return fold;
  const Hollow hollow(*knee, skin);
  if (!hollow.found()) return fold;
  for (std::uint32_t k = 0; k < skin.points.size(); ++k) {
    const Eigen::Vector3f shift = hollow.shift(skin.points[k], skin.normals[k]).cast<float>();
    if (shift.norm() < kSeen_m) continue;
    ShadedMesh::Root root;
    root.vertex = k;
    root.shift = {shift.x(), shift.y(), shift.z()};
    fold.push_back(root);
  }
  return fold;
}

std::vector<float> fold_openness(const std::vector<ShadedMesh::Root>& fold, const Surface& skin) {
  std::vector<float> open(skin.points.size(), 1.0f);
  for (const ShadedMesh::Root& root : fold) {
    const Eigen::Vector3f shift(root.shift[0], root.shift[1], root.shift[2]);
    const double deep = static_cast<double>(shift.norm()) / kDeep_m;
    open[root.vertex] = static_cast<float>(1 - (1 - kLeastOpen) * eased(0.2, 0.9, deep));
  }
  smooth(skin, 2, open);
  return open;
}

}  // namespace osteon
