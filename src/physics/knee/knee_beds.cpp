#include "knee/knee_beds.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr double kLeastLayer_m = 0.0004;  // nearer to bone, a triangle is the layer's underside
constexpr double kLeastStack_m = 0.001;   // thinner ones are not reckoned stiffer

constexpr double kFine_m = 0.0012;  // edge below which a triangle is not divided

double longest_edge(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

double stiffness_of(const CartilageLaw& law, double thickness, double area) {
  const double modulus =
      law.young_pa * (1 - law.poisson) / ((1 + law.poisson) * (1 - 2 * law.poisson));
  return modulus * area / std::max(kLeastStack_m, thickness + law.other_m);
}

double area_of(const std::array<Vec3, 3>& corner) {
  return 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
}

void lay_bed(const std::array<Vec3, 3>& corner, const MeshDistance& bone, const CartilageLaw& law,
             std::vector<JointBed>& beds) {
  const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
  const ClosestPoint base = bone.closest(middle);
  const double thickness = (middle - base.point).norm();
  if (thickness < kLeastLayer_m) return;
  beds.push_back({base.point, thickness, stiffness_of(law, thickness, area_of(corner))});
}

}  // namespace

std::vector<JointBed> lay_beds(const TriMesh& layer, const MeshDistance& bone,
                               const CartilageLaw& law) {
  std::vector<JointBed> beds;
  for (const Triangle& t : layer.triangles) {
    const Vec3 &a = layer.vertices[t[0]], &b = layer.vertices[t[1]], &c = layer.vertices[t[2]];
    if (longest_edge(a, b, c) < kFine_m) {
      lay_bed({a, b, c}, bone, law, beds);
      continue;
    }
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    lay_bed({a, ab, ca}, bone, law, beds);
    lay_bed({ab, b, bc}, bone, law, beds);
    lay_bed({ca, bc, c}, bone, law, beds);
    lay_bed({ab, bc, ca}, bone, law, beds);
  }
  return beds;
}

std::vector<JointBed> lay_spine_beds(const MeshDistance& tibia, const MeshDistance& femur,
                                     const std::vector<TriMesh>& plateaus, double scale,
                                     const CartilageLaw& law) {
  constexpr double kHalfWidth_m = 0.013, kNear_m = 0.012;
  std::vector<MeshDistance> layers;
  for (const TriMesh& layer : plateaus) layers.emplace_back(layer);
  const TriMesh& bone = tibia.mesh();
  std::vector<JointBed> beds;
  for (const Triangle& t : bone.triangles) {
    const std::array<Vec3, 3> corner{bone.vertices[t[0]], bone.vertices[t[1]], bone.vertices[t[2]]};
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
    if (std::abs(middle.y()) > scale * kHalfWidth_m) continue;
    if (femur.closest(middle).signed_distance > scale * kNear_m) continue;
    bool covered = false;
    for (const MeshDistance& layer : layers)
      covered = covered || std::abs(layer.closest(middle).signed_distance) < kLeastLayer_m;
    if (!covered)
      beds.push_back({middle, law.other_m, stiffness_of(law, law.other_m, area_of(corner))});
  }
  return beds;
}

}  // namespace osteon
