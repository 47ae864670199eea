#include "repair/orient.h"

#include <cmath>
#include <utility>

#include "repair/patches.h"

namespace osteon {
namespace {

void flip(Triangle& t) { std::swap(t[1], t[2]); }

// Signed volume of the cone from the patch's middle, and the patch's area.
std::pair<double, double> volume_and_area(const TriMesh& mesh, const Patch& patch) {
  Vec3 middle = Vec3::Zero();
  double total_area = 0;
  for (const std::uint32_t i : patch.triangles) {
    const Triangle& t = mesh.triangles[i];
    const double weight = triangle_area(mesh, i);
    middle += weight / 3 * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
    total_area += weight;
  }
  if (!(total_area > 0)) return {0, 0};
  middle /= total_area;
  double six_volumes = 0;
  for (const std::uint32_t i : patch.triangles) {
    const Triangle& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices[t[0]] - middle;
    const Vec3 b = mesh.vertices[t[1]] - middle;
    const Vec3 c = mesh.vertices[t[2]] - middle;
    six_volumes += a.dot(b.cross(c));
  }
  return {six_volumes / 6, total_area};
}

// Winding number of the patch about p by solid angles (van Oosterom and Strackee 1983, eq. 8).
double winding_number(const TriMesh& mesh, const Patch& patch, const Vec3& p) {
  double half_angle = 0;
  for (const std::uint32_t i : patch.triangles) {
    const Triangle& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices[t[0]] - p;
    const Vec3 b = mesh.vertices[t[1]] - p;
    const Vec3 c = mesh.vertices[t[2]] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    half_angle +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angle / (2 * M_PI);
}

bool box_holds(const Aabb& outer, const Aabb& inner) {
  return (outer.lo.array() < inner.lo.array()).all() && (inner.hi.array() < outer.hi.array()).all();
}

bool is_cavity(const TriMesh& mesh, const std::vector<Patch>& patches, const Patch& patch) {
  const Vec3& p = mesh.vertices[mesh.triangles[patch.triangles.front()][0]];
  bool odd = false;
  for (const Patch& other : patches)
    if (other.closed && box_holds(other.box, patch.box) &&
        std::abs(winding_number(mesh, other, p)) > 0.5)
      odd = !odd;
  return odd;
}

}  // namespace

std::vector<char> orient_alike(TriMesh& mesh) {
  std::vector<char> turned(mesh.triangles.size(), 0);
  for (const Patch& patch : patches_of(mesh)) {
    double kept_area = 0;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      kept_area += (patch.against[i] ? -1 : 1) * triangle_area(mesh, patch.triangles[i]);
    const char whole = kept_area < 0 ? 1 : 0;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      turned[patch.triangles[i]] = static_cast<char>(patch.against[i] ^ whole);
  }
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) flip(mesh.triangles[t]);
  return turned;
}

std::vector<char> orient_outwards(TriMesh& mesh) {
  // Volume of a sphere of the same area, times this: less is a sheet.
  constexpr double kSheet = 1e-6;
  std::vector<char> turned(mesh.triangles.size(), 0);
  const std::vector<Patch> patches = patches_of(mesh);
  for (const Patch& patch : patches) {
    const auto [signed_volume, total_area] = volume_and_area(mesh, patch);
    if (std::abs(signed_volume) <= kSheet * total_area * std::sqrt(total_area)) continue;
    const bool inwards = signed_volume < 0;
    const bool wanted_inwards = patch.closed && is_cavity(mesh, patches, patch);
    if (inwards == wanted_inwards) continue;
    for (const std::uint32_t t : patch.triangles) turned[t] = 1;
  }
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) flip(mesh.triangles[t]);
  return turned;
}

}  // namespace osteon
