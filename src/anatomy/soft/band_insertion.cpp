#include "soft/band_insertion.h"

#include <algorithm>
#include <cmath>

#include "bone/nearby_surface.h"

namespace osteon {
namespace {

constexpr int kFootprintSteps = 6;
constexpr double kFootprint = 0.5;     // of the width (D)
constexpr double kFootprint_m = 5e-3;  // at most (D)
constexpr double kSunk = 0.4;          // of half the thickness, of a tip on the surface (D)
constexpr double kBelow_m = 3e-4;      // over a root that goes straight down lies so much bone

Vec3 normal_at(const SoftGround& bone, const ClosestPoint& at) {
  const Triangle& t = bone.surface.mesh().triangles[at.triangle];
  const Vec3 sum = bone.normals[t[0]] + bone.normals[t[1]] + bone.normals[t[2]];
  const double length = sum.norm();
  return length > 1e-12 ? Vec3(sum / length) : Vec3(Vec3::UnitZ());
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct NearBone {
  double distance = 1e300;
  Vec3 normal = Vec3::UnitZ();
};

NearBone nearest_bone(const Vec3& p, double reach, const GroundView& ground) {
  NearBone nearest;
  for (const SoftGround* bone : ground) {
    if (distance_to_box(p, bone->box) >= reach) continue;
    const ClosestPoint at = bone->surface.closest(p);
    if (at.signed_distance >= std::min(reach, nearest.distance)) continue;
    nearest = {at.signed_distance, normal_at(*bone, at)};
  }
  return nearest;
}

/// The same direction again and again evened out with its neighbours'.
void even_out(std::vector<Vec3>& directions) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vec3> before = directions;
    for (std::size_t i = 1; i + 1 < directions.size(); ++i) {
      const Vec3 sum = before[i - 1] + 2 * before[i] + before[i + 1];
      if (sum.norm() > 1e-6) directions[i] = sum.normalized();
    }
  }
}

}  // namespace

std::vector<BandStation> insertion(const BandStation& end, const Vec3& onward,
                                   const SoftGround& bone) {
  const Vec3 normal = normal_at(bone, bone.surface.closest(end.p));
  const Vec3 over = onward - onward.dot(normal) * normal;
  const double footprint = std::min(kFootprint * end.width, kFootprint_m);
  // What runs out along the surface in a thin wedge would be cut to rags by it.
  const double half = 0.5 * end.thickness, flush = over.norm();
  const double depth = flush * kSunk * half + (1 - flush) * (half + kBelow_m);
  std::vector<BandStation> stations;
  for (int k = 1; k <= kFootprintSteps; ++k) {
    const double share = static_cast<double>(k) / kFootprintSteps;
    const double narrowed = std::sqrt(1 - share * share);  // a rounded tip
    BandStation s = end;
    const ClosestPoint at = bone.surface.closest(end.p + share * footprint * over);
    s.p = at.point - share * share * depth * normal_at(bone, at);
    s.width = std::max(s.thickness, narrowed * s.width);
    stations.push_back(s);
  }
  return stations;
}

std::vector<Vec3> turned_flat_on_bone(const std::vector<BandStation>& stations,
                                      std::vector<Vec3> wanted, const GroundView& ground) {
  constexpr double kPull = 6;                    // of a bone that the band lies on
  constexpr double kSquare = 0.2, kAlong = 0.5;  // cosines between which a bone comes to count
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double on = 0.5 * stations[i].thickness, off = on + 0.5 * stations[i].width;
    const NearBone bone = nearest_bone(stations[i].p, off, ground);
    if (bone.distance >= off) continue;
    const double cosine = bone.normal.dot(wanted[i]);
    const double share = smooth_step((off - bone.distance) / (off - on)) *
                         smooth_step((std::abs(cosine) - kSquare) / (kAlong - kSquare));
    wanted[i] = (wanted[i] + std::copysign(kPull * share, cosine) * bone.normal).normalized();
  }
  even_out(wanted);
  return wanted;
}

}  // namespace osteon
