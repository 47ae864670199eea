#include "osteon/render/prepare.h"

#include <algorithm>
#include <cmath>

#include "coarser_levels.h"
#include "occlusion.h"
#include "osteon/render/felt_colors.h"
#include "osteon/scene/felt_distance.h"
#include "surface.h"

namespace osteon {
namespace {

constexpr double kOcclusionReach_m = 0.012;   // of the order of a carpal bone
constexpr double kFullCurvature_per_m = 700;  // a ridge this sharp is drawn as light as it gets
constexpr std::size_t kSoftRays = 300'000;    // for all soft parts
constexpr double kOcclusionShare = 0.7;       // of the time that all takes

/// Value of a lattice point, 0..1 (integer hash after Jarzynski and Olano 2020, "pcg3d").
double lattice(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto a = static_cast<std::uint32_t>(x) * 1664525u + 1013904223u;
  auto b = static_cast<std::uint32_t>(y) * 1664525u + 1013904223u;
  auto c = static_cast<std::uint32_t>(z) * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    a += b * c;
    b += c * a;
    c += a * b;
    a ^= a >> 16;
    b ^= b >> 16;
    c ^= c >> 16;
  }
  return (a >> 8) * (1.0 / 16777216.0);
}

/// Smooth noise, 0..1, with features of about one unit.
double value_noise(const Vec3& p) {
  const Vec3 cell = p.array().floor();
  const Vec3 f = p - cell;
  const Vec3 s = f.array() * f.array() * (3 - 2 * f.array());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const double weight =
        (i ? s.x() : 1 - s.x()) * (j ? s.y() : 1 - s.y()) * (k ? s.z() : 1 - s.z());
    sum += weight * lattice(static_cast<std::int64_t>(cell.x()) + i,
                            static_cast<std::int64_t>(cell.y()) + j,
                            static_cast<std::int64_t>(cell.z()) + k);
  }
  return sum;
}

/// Patches of 9 mm with finer ones of 2.5 mm in them; no bone has the pattern of another.
double mottle(const Vec3& p_B, std::size_t bone) {
  if (p_B.cwiseAbs().maxCoeff() > 1e3) return 0.5;  // lattice indices stay within 64 bits
  const Vec3 apart = Vec3::Constant(17.3 * static_cast<double>(bone + 1));
  return 0.65 * value_noise(p_B / 0.009 + apart) + 0.35 * value_noise(p_B / 0.0025 + apart);
}

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

ShadedMesh shaded(const Surface& s, const std::vector<float>& openness, std::size_t bone) {
  std::vector<float> curvature = mean_curvature(s);
  smooth(s, 2, curvature);
  ShadedMesh out;
  out.triangles = s.triangles;
  out.closed = encloses_volume(s);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    out.positions.push_back(to_floats(s.points[k]));
    out.normals.push_back(to_floats(s.normals[k]));
    const double cavity = 0.5 + 0.5 * curvature[k] / kFullCurvature_per_m;
    out.shades.push_back(
        {to_byte(openness[k]), to_byte(cavity), to_byte(mottle(s.points[k], bone)), felt_byte(0)});
  }
  return out;
}

/// The skin hides nothing: it is looked through.
bool is_skin(const SoftPart& soft) { return soft.kind == "skin"; }

std::vector<ShadedMesh> prepare_softs(const Case& the_case, const std::vector<PlacedSurface>& bones,
                                      bool stopped) {
  std::vector<PlacedSurface> surfaces;
  for (const SoftPart& soft : the_case.softs)
    if (!is_skin(soft)) surfaces.push_back({make_surface(soft.mesh_W), Pose{}});
  const auto go_on = [stopped](double) { return !stopped; };
  const auto openness = sky_openness(surfaces, bones, kOcclusionReach_m, kSoftRays, go_on);
  std::vector<ShadedMesh> out;
  std::size_t next = 0;
  for (const SoftPart& soft : the_case.softs) {
    const bool skin = is_skin(soft);
    const Surface own = skin ? make_surface(soft.mesh_W) : Surface{};
    const Surface& surface = skin ? own : surfaces[next].surface;
    const std::vector<float> open(skin ? surface.points.size() : 0, 1.0f);
    out.push_back(shaded(surface, skin ? open : openness[next], out.size()));
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
    const double done = static_cast<double>(k + 1) / static_cast<double>(surfaces.size());
    if (!stopped) out.bones.back().coarser = coarser_levels(out.bones.back());
    report(kOcclusionShare + (1 - kOcclusionShare) * done);
  }
  out.softs = prepare_softs(the_case, surfaces, stopped);
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
