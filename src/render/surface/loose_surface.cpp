#include "surface/loose_surface.h"

#include <cmath>

#include "surface/bone_mottle.h"

namespace osteon {
namespace {

constexpr double kOldSurface_m = 0.0003;  // less deep is the bone's surface as it was
constexpr std::uint8_t kOpen = 255, kOpenCut = 205, kFlatPiece = 128, kCutPiece = 100;

std::array<float, 3> floats_of_piece(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

ShadedMesh loose_shaded(const SurfaceCube& surface, std::size_t bone) {
  ShadedMesh out;
  out.triangles = surface.triangles;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec3& p_B = surface.vertices[v];
    out.positions.push_back(floats_of_piece(p_B));
    out.normals.push_back(
        floats_of_piece(v < surface.normals.size() ? surface.normals[v] : Vec3::UnitZ()));
    const double depth = v < surface.depth_m.size() ? static_cast<double>(surface.depth_m[v]) : 0;
    const bool cut = depth > kOldSurface_m;
    const auto mottle = static_cast<std::uint8_t>(std::lround(255 * bone_mottle(p_B, bone)));
    out.shades.push_back(
        {cut ? kOpenCut : kOpen, cut ? kCutPiece : kFlatPiece, mottle, kFlatPiece});
  }
  return out;
}

}  // namespace osteon
