#include "osteon/surgeon/approach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr int kCandidates = 400;
constexpr double kOverBone_m = 0.0002;
constexpr double kLeastStride_m = 0.0005;
constexpr double kEnoughClearance_m = 0.004;

// A place on one of the bone's convex pieces with the normal there; facets by chance, weighted by
// nothing: small ones lie at the ends, where bones show.
Approach random_place(const Bone& bone, Random& random) {
  const Hull& piece = bone.pieces[random.next() % bone.pieces.size()];
  const std::size_t facet = random.next() % piece.triangles.size();
  const Triangle& t = piece.triangles[facet];
  double a = random.uniform();
  double b = random.uniform();
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  const Vec3& v0 = piece.vertices[t[0]];
  const Vec3 p_B = v0 + a * (piece.vertices[t[1]] - v0) + b * (piece.vertices[t[2]] - v0);
  Approach place;
  place.p_W = bone.X_WB * p_B;
  place.n_W = bone.X_WB.rotate(piece.planes[piece.plane_of[facet]].n);
  return place;
}

double gap_to_others(const Case& the_case, std::uint32_t bone, const Vec3& p_W) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < the_case.bones.size(); ++i)
    if (i != bone) gap = std::min(gap, gap_to(the_case.bones[i], p_W));
  return gap;
}

// Whether the bone goes on about the place: on an edge a probe slips off.
bool is_broad(const Bone& bone, const Approach& way) {
  constexpr double kAround_m = 0.001, kFall_m = 0.0004;
  const Vec3 any = std::abs(way.n_W.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 e1 = way.n_W.cross(any).normalized() * kAround_m;
  const Vec3 e2 = way.n_W.cross(e1);
  for (const Vec3& u : {Vec3(e1), Vec3(-e1), Vec3(e2), Vec3(-e2)})
    if (gap_to(bone, way.p_W + u) > kFall_m) return false;
  return true;
}

// Walks outwards in strides no longer than the room there is; false when something is in the way.
bool way_is_free(const Case& the_case, std::uint32_t bone, const Surroundings& around,
                 double tip_radius_m, Approach& way) {
  way.clearance_m = std::numeric_limits<double>::infinity();
  const Vec3 start = way.p_W + way.n_W * (tip_radius_m + kOverBone_m);
  for (double along = 0; along < 2 * around.radius_m;) {
    const Vec3 p = start + way.n_W * along;
    const double others = gap_to_others(the_case, bone, p) - tip_radius_m;
    const double own = gap_to(the_case.bones[bone], p) - tip_radius_m;
    way.clearance_m = std::min(way.clearance_m, others);
    if (others <= 0.0003 || own < 0) return false;
    along += std::max(kLeastStride_m, std::min(others, 0.01));
  }
  return true;
}

// Lays a line over the bone, both ways from the place, along which the tool stays on it and clear
// of the others.
void lay_line(const Case& the_case, std::uint32_t bone, double tip_radius_m, Approach& way) {
  const Bone& b = the_case.bones[bone];
  const Vec3 any = std::abs(way.n_W.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 e1 = way.n_W.cross(any).normalized();
  const Vec3 e2 = way.n_W.cross(e1);
  constexpr int kDirections = 12;
  constexpr double kStride_m = 0.0005;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * 3.14159265358979 * k / kDirections;
    const Vec3 u = std::cos(angle) * e1 + std::sin(angle) * e2;
    double free_m = 0;
    while (free_m < 0.03) {
      const Vec3 p = way.p_W + u * (free_m + kStride_m);
      if (gap_to(b, p) > 0.0015) break;
      if (gap_to_others(the_case, bone, p + way.n_W * tip_radius_m) < 2 * tip_radius_m) break;
      free_m += kStride_m;
    }
    if (free_m > way.free_m) {
      way.free_m = free_m;
      way.along_W = u;
    }
  }
}

}  // namespace

Surroundings surroundings_of(const Case& the_case) {
  const Aabb box = the_case.bounds_W();
  return {box.center(), 0.5 * box.extent().norm() + 0.02};
}

double gap_to(const Bone& bone, const Vec3& p_W) {
  const Vec3 p_B = bone.X_WB.inverse() * p_W;
  double gap = std::numeric_limits<double>::infinity();
  for (const Hull& piece : bone.pieces) {
    double out = -std::numeric_limits<double>::infinity();
    for (const Plane& plane : piece.planes) {
      out = std::max(out, plane.signed_distance(p_B));
      if (out >= gap) break;
    }
    gap = std::min(gap, out);
  }
  return gap;
}

std::optional<Approach> find_approach(const Case& the_case, std::uint32_t bone, double tip_radius_m,
                                      std::uint64_t seed) {
  Random random(seed * 1000003 + bone);
  const Surroundings around = surroundings_of(the_case);
  std::optional<Approach> best;
  for (int k = 0; k < kCandidates; ++k) {
    Approach way = random_place(the_case.bones[bone], random);
    if (!is_broad(the_case.bones[bone], way)) continue;
    if (!way_is_free(the_case, bone, around, tip_radius_m, way)) continue;
    if (!best || way.clearance_m > best->clearance_m) best = way;
    if (best->clearance_m > kEnoughClearance_m) break;
  }
  if (best) lay_line(the_case, bone, tip_radius_m, *best);
  return best;
}

}  // namespace osteon
