#include "surface/changed_cubes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gl/frame.h"
#include "surface/bone_mottle.h"

namespace osteon {
namespace {

constexpr GLuint kUnit = 1;  // texture unit of the mask
constexpr std::uint64_t kMostCubes = 1u << 24;
constexpr double kOnSurface_m = 0.0003;  // less deep is the surface as it was
constexpr double kDark_m = 0.008;        // so deep a hole sees a quarter of the sky
constexpr std::uint8_t kFlat = 128, kCutCavity = 100;

std::uint64_t cubes_of(const std::array<int, 3>& count) {
  std::uint64_t all = 1;
  for (const int n : count) all = n > 0 ? all * static_cast<std::uint64_t>(n) : 0;
  return all;
}

std::array<int, 3> place_of(const std::array<int, 3>& count, std::uint32_t cube) {
  const int c = static_cast<int>(cube);
  return {c % count[0], c / count[0] % count[1], c / count[0] / count[1]};
}

// None: outside of the grid.
std::optional<std::array<int, 3>> cube_at(const CubeGrid& grid, const Vec3& p) {
  const Vec3 u = (grid.X_GM * p - grid.lo_B) / grid.side_m;
  std::array<int, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::floor(u[static_cast<Eigen::Index>(k)]);
    if (!(x >= 0 && x < grid.count[k])) return std::nullopt;
    at[k] = static_cast<int>(x);
  }
  return at;
}

std::size_t index_of(const std::array<int, 3>& count, const std::array<int, 3>& at) {
  return static_cast<std::size_t>((at[2] * count[1] + at[1]) * count[0] + at[0]);
}

Vec3 widened(const std::array<float, 3>& p) {
  return Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
}

std::array<float, 3> narrowed(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

void ChangedCubes::set_base(const ShadedMesh& mesh) {
  base_ = mesh.positions;
  base_shades_ = mesh.shades;
  base_in_.clear();
  if (!empty()) sort_base({lo_B_, side_m_, count_, overlap_m_, X_GM_});
}

void ChangedCubes::sort_base(const CubeGrid& grid) {
  base_in_.assign(cubes_of(grid.count), {});
  for (std::uint32_t v = 0; v < base_.size(); ++v)
    if (const auto at = cube_at(grid, widened(base_[v])))
      base_in_[index_of(grid.count, *at)].push_back(v);
}

void ChangedCubes::clear() {
  surfaces_.clear();
  mask_ = {};
  base_in_.clear();
  side_m_ = 0;
}

bool ChangedCubes::fits(const CubeGrid& grid) const {
  GLint most = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
  const auto all = cubes_of(grid.count);
  return grid.side_m > 0 && is_finite(grid.lo_B) && all > 0 && all <= kMostCubes &&
         *std::max_element(grid.count.begin(), grid.count.end()) <= most;
}

void ChangedCubes::begin(const CubeGrid& grid) {
  clear();
  lo_B_ = grid.lo_B;
  X_GM_ = grid.X_GM;
  side_m_ = grid.side_m;
  count_ = grid.count;
  overlap_m_ = grid.overlap_m;
  sort_base(grid);
  mask_ = make_texture();
  const std::vector<std::uint8_t> none(cubes_of(count_), 0);
  glActiveTexture(GL_TEXTURE0 + kUnit);
  glBindTexture(GL_TEXTURE_3D, mask_.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, count_[0], count_[1], count_[2], 0, GL_RED,
               GL_UNSIGNED_BYTE, none.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindTexture(GL_TEXTURE_3D, 0);
  glActiveTexture(GL_TEXTURE0);
}

void ChangedCubes::set(const CubeGrid& grid, std::span<const SurfaceCube> cubes, std::size_t bone) {
  if (cubes.empty() || !fits(grid)) return;
  if (!is_on(grid)) begin(grid);
  const std::uint8_t changed = 255;
  glActiveTexture(GL_TEXTURE0 + kUnit);
  glBindTexture(GL_TEXTURE_3D, mask_.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const SurfaceCube& cube : cubes) {
    if (cube.cube >= cubes_of(count_)) continue;
    const auto at = place_of(count_, cube.cube);
    glTexSubImage3D(GL_TEXTURE_3D, 0, at[0], at[1], at[2], 1, 1, 1, GL_RED, GL_UNSIGNED_BYTE,
                    &changed);
    surfaces_.insert_or_assign(cube.cube, GpuMesh(shaded(grid, cube, bone)));
  }
  glBindTexture(GL_TEXTURE_3D, 0);
  glActiveTexture(GL_TEXTURE0);
}

Aabb ChangedCubes::box_of(std::uint32_t cube) const {
  const auto at = place_of(count_, cube);
  const Pose X_MG = X_GM_.inverse();
  const Vec3 lo_G = lo_B_ + side_m_ * Vec3(at[0], at[1], at[2]);
  Aabb box;
  for (int corner = 0; corner < 8; ++corner)
    box.include(X_MG * (lo_G + side_m_ * Vec3(corner & 1, corner >> 1 & 1, corner >> 2)));
  return box.grown(overlap_m_);
}

// Of the nearest vertex of the base in this cube and those about it.
ShadedMesh::Shade ChangedCubes::shade_near(const CubeGrid& grid, const Vec3& p_B) const {
  ShadedMesh::Shade best{255, kFlat, kFlat, kFlat};
  const auto at = cube_at(grid, p_B);
  if (!at) return best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> near{(*at)[0] + n % 3 - 1, (*at)[1] + n / 3 % 3 - 1,
                                  (*at)[2] + n / 9 - 1};
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && near[k] >= 0 && near[k] < count_[k];
    if (!inside) continue;
    for (const std::uint32_t v : base_in_[index_of(count_, near)]) {
      const double away = (widened(base_[v]) - p_B).squaredNorm();
      if (!(away < least)) continue;
      least = away;
      best = base_shades_[v];
    }
  }
  return best;
}

// What was cut open sees the less of the sky the deeper it lies.
ShadedMesh ChangedCubes::shaded(const CubeGrid& grid, const SurfaceCube& cube,
                                std::size_t bone) const {
  ShadedMesh out;
  out.triangles = cube.triangles;
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    const Vec3& p_B = cube.vertices[v];
    out.positions.push_back(narrowed(p_B));
    out.normals.push_back(narrowed(v < cube.normals.size() ? cube.normals[v] : Vec3::UnitZ()));
    ShadedMesh::Shade shade = shade_near(grid, p_B);
    if (bone != kSoft)
      shade.mottle = static_cast<std::uint8_t>(std::lround(255 * bone_mottle(p_B, bone)));
    const double depth = v < cube.depth_m.size() ? static_cast<double>(cube.depth_m[v]) : 0;
    if (depth > kOnSurface_m) {
      const double open = std::clamp(1 - 0.75 * depth / kDark_m, 0.25, 1.0);
      shade.openness = static_cast<std::uint8_t>(std::lround(255 * open));
      shade.cavity = kCutCavity;
      shade.felt = kFlat;
    }
    out.shades.push_back(shade);
  }
  return out;
}

void ChangedCubes::hide(const Program& program, bool clear) const {
  glActiveTexture(GL_TEXTURE0 + kUnit);
  glBindTexture(GL_TEXTURE_3D, mask_.get());
  glActiveTexture(GL_TEXTURE0);
  program.set("u_changed", static_cast<int>(kUnit));
  const Eigen::Vector3f lo = lo_B_.cast<float>();
  program.set("u_changed_from",
              Eigen::Vector4f(lo.x(), lo.y(), lo.z(), static_cast<float>(side_m_)));
  program.set("u_changed_grid", to_matrix(X_GM_));
  program.set("u_changed_overlap", clear ? 0.0f : static_cast<float>(overlap_m_));
}

void ChangedCubes::draw() const {
  for (const auto& [cube, surface] : surfaces_) surface.draw();
}

void ChangedCubes::draw(const std::function<bool(const GpuMesh::Chunk&)>& wanted) const {
  for (const auto& [cube, surface] : surfaces_) surface.draw(wanted);
}

}  // namespace osteon
