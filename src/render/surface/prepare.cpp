#include "osteon/render/prepare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osteon/render/felt_colors.h"
#include "osteon/render/prepare_unlit.h"
#include "osteon/scene/felt_distance.h"
#include "surface/bone_mottle.h"
#include "surface/coarser_levels.h"
#include "surface/creases.h"
#include "surface/occlusion.h"
#include "surface/rooted.h"
#include "surface/skin_fold.h"
#include "surface/surface.h"

namespace osteon {
namespace {

constexpr double kOcclusionReach_m = 0.012;   // of the order of a carpal bone
constexpr double kFullCurvature_per_m = 700;  // a ridge this sharp is drawn as light as it gets
constexpr std::size_t kSoftRays = 300'000;    // for all soft parts
constexpr double kOcclusionShare = 0.7;       // of the time that all takes

std::uint8_t to_byte(double value) {
  const double kept = value > 0 ? std::min(value, 1.0) : 0.0;  // NaN gives 0
  return static_cast<std::uint8_t>(std::lround(255 * kept));
}

std::array<float, 3> to_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::uint8_t felt_byte(double height_m) {
  const double share = std::clamp(height_m / kFeltRange_m, -1.0, 1.0);
  return static_cast<std::uint8_t>(128 + std::lround(127 * share));
}

using Roots = std::vector<ShadedMesh::Root>;

ShadedMesh shaded(const Surface& s, const std::vector<float>& openness, std::size_t bone,
                  Roots roots = {}) {
  std::vector<float> curvature = mean_curvature(s);
  fill_buried(roots, s, curvature);
  smooth(s, 2, curvature);
  ShadedMesh out;
  out.roots = std::move(roots);
  out.triangles = s.triangles;
  out.closed = encloses_volume(s);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    out.positions.push_back(to_floats(s.points[k]));
    out.normals.push_back(to_floats(s.normals[k]));
    const double cavity = 0.5 + 0.5 * curvature[k] / kFullCurvature_per_m;
    out.shades.push_back({to_byte(openness[k]), to_byte(cavity),
                          to_byte(bone_mottle(s.points[k], bone)), felt_byte(0)});
  }
  return out;
}

/// Where cartilage thins out to its rim it takes on the colour of what lies under it.
void thin_out(const Case& the_case, const SoftPart& soft, const Surface& surface,
              ShadedMesh& mesh) {
  constexpr double kThick_m = 0.00045;
  if (soft.kind != "cartilage") return;
  const std::vector<double> heights = heights_over_bones(the_case, soft, surface);
  for (std::size_t k = 0; k < heights.size(); ++k)
    mesh.shades[k].mottle =
        static_cast<std::uint8_t>(std::lround(128 * std::clamp(heights[k] / kThick_m, 0.0, 1.0)));
}

/// The skin hides nothing: it is looked through.
bool is_skin(const SoftPart& soft) { return soft.kind == "skin"; }

ShadedMesh prepare_skin(const Case& the_case, const SoftPart& skin, std::size_t soft) {
  Surface surface = make_surface(skin.mesh_W);
  Roots fold = find_fold(the_case, surface);
  draw_in(fold, surface);
  const std::vector<float> open = fold_openness(fold, surface);
  return shaded(surface, open, soft, std::move(fold));
}

std::vector<ShadedMesh> prepare_softs(const Case& the_case, const std::vector<PlacedSurface>& bones,
                                      const PrepareProgress& go_on) {
  std::vector<PlacedSurface> surfaces;
  std::vector<Roots> roots;
  for (const SoftPart& soft : the_case.softs) {
    if (is_skin(soft)) continue;
    surfaces.push_back({make_surface(soft.mesh_W), Pose{}});
    roots.push_back(find_roots(the_case, soft, surfaces.back().surface));
    draw_in(roots.back(), surfaces.back().surface);
  }
  auto openness = sky_openness(surfaces, bones, kOcclusionReach_m, kSoftRays, go_on);
  std::vector<ShadedMesh> out;
  std::size_t next = 0;
  for (const SoftPart& soft : the_case.softs) {
    const bool skin = is_skin(soft);
    if (skin) {
      out.push_back(prepare_skin(the_case, soft, out.size()));
    } else {
      const Surface& surface = surfaces[next].surface;
      fill_buried(roots[next], surface, openness[next]);
      out.push_back(shaded(surface, openness[next], out.size(), std::move(roots[next])));
      thin_out(the_case, soft, surface, out.back());
    }
    if (go_on(1)) out.back().coarser = coarser_levels(out.back());
    if (!skin) ++next;
  }
  return out;
}

}  // namespace

PreparedCase prepare_case(const Case& the_case, const PrepareProgress& progress) {
  std::vector<PlacedSurface> surfaces;
  for (const Bone& bone : the_case.bones) surfaces.push_back({make_surface(bone.mesh), bone.X_WB});
  bool stopped = false;
  const auto report = [&](double share) {
    stopped = stopped || (progress && !progress(share));
    return !stopped;
  };
  const auto openness = sky_openness(surfaces, {}, kOcclusionReach_m, kRayBudget,
                                     [&](double share) { return report(kOcclusionShare * share); });
  PreparedCase out;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    out.bones.push_back(shaded(surfaces[k].surface, openness[k], k));
    split_creases(surfaces[k].surface, out.bones.back());
    const double done = static_cast<double>(k + 1) / static_cast<double>(surfaces.size());
    if (!stopped) out.bones.back().coarser = coarser_levels(out.bones.back());
    report(kOcclusionShare + (1 - kOcclusionShare) * done);
  }
  out.softs = prepare_softs(the_case, surfaces, [&](double) { return report(1); });
  return out;
}

ShadedMesh unlit_bone(const Case& the_case, std::size_t bone) {
  const Surface surface = make_surface(the_case.bones[bone].mesh);
  ShadedMesh mesh = shaded(surface, std::vector<float>(surface.points.size(), 1.0f), bone);
  split_creases(surface, mesh);
  mesh.coarser = coarser_levels(mesh);
  return mesh;
}

ShadedMesh unlit_soft(const Case& the_case, std::size_t soft) {
  if (is_skin(the_case.softs[soft])) return prepare_skin(the_case, the_case.softs[soft], soft);
  Surface surface = make_surface(the_case.softs[soft].mesh_W);
  Roots roots = find_roots(the_case, the_case.softs[soft], surface);
  draw_in(roots, surface);
  ShadedMesh mesh =
      shaded(surface, std::vector<float>(surface.points.size(), 1.0f), soft, std::move(roots));
  thin_out(the_case, the_case.softs[soft], surface, mesh);
  return mesh;
}

PreparedCase prepare_unlit(const Case& the_case) {
  PreparedCase out;
  for (std::size_t k = 0; k < the_case.bones.size(); ++k)
    out.bones.push_back(unlit_bone(the_case, k));
  for (std::size_t k = 0; k < the_case.softs.size(); ++k)
    out.softs.push_back(unlit_soft(the_case, k));
  return out;
}

void prepare_felt(const Case& the_case, PreparedCase& prepared, const PrepareProgress& progress) {
  const std::size_t count = std::min(the_case.bones.size(), prepared.bones.size());
  for (std::size_t k = 0; k < count; ++k) {
    ShadedMesh& mesh = prepared.bones[k];
    std::vector<Vec3> points_B;
    points_B.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions)
      points_B.push_back(Eigen::Vector3f(p[0], p[1], p[2]).cast<double>());
    const std::vector<double> heights = felt_heights(the_case.bones[k], points_B);
    for (std::size_t v = 0; v < heights.size(); ++v) mesh.shades[v].felt = felt_byte(heights[v]);
    const double done = static_cast<double>(k + 1) / static_cast<double>(count);
    if (progress && !progress(done)) return;
  }
}

}  // namespace osteon
