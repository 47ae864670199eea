#include "view/picker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene_painter.h"

namespace osteon {

namespace {

constexpr std::uint64_t kMostPickedCubes = 1u << 24;

bool meets(const Aabb& box, const Vec3& origin, const Vec3& dir) {
  double from = 0, to = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < 3; ++k) {
    double a = (box.lo[k] - origin[k]) / dir[k], b = (box.hi[k] - origin[k]) / dir[k];
    if (dir[k] == 0) {
      if (origin[k] < box.lo[k] || origin[k] > box.hi[k]) return false;
      continue;
    }
    if (a > b) std::swap(a, b);
    from = std::max(from, a);
    to = std::min(to, b);
  }
  return from <= to;
}

bool same_grid(const CubeGrid& a, const CubeGrid& b) {
  return a.lo_B == b.lo_B && a.side_m == b.side_m && a.count == b.count;
}

}  // namespace

bool Picker::Changed::at(const Vec3& p_G) const {
  const Vec3 u = (p_G - grid.lo_B) / grid.side_m;
  std::array<int, 3> cube{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::floor(u[static_cast<Eigen::Index>(k)]);
    if (!(x >= 0 && x < grid.count[k])) return false;
    cube[k] = static_cast<int>(x);
  }
  const int index = (cube[2] * grid.count[1] + cube[1]) * grid.count[0] + cube[0];
  return is[static_cast<std::size_t>(index)] != 0;
}

// As the shader does (shaders/changed.glsl).
bool Picker::left_out(const Changed& changed, const Vec3& p_B) const {
  if (changed.is.empty()) return false;
  const Vec3 p_G = changed.grid.X_GM * p_B;
  for (int n = 0; n < 8; ++n) {
    const Vec3 corner(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1);
    if (!changed.at(p_G + changed.grid.overlap_m * corner)) return false;
  }
  return true;
}

// The first place of the surface as it was that is still shown.
std::optional<double> Picker::hit_base(std::size_t bone, const Vec3& origin, const Vec3& dir,
                                       double most) const {
  constexpr double kOn_m = 1e-7;
  constexpr int kMostLayers = 64;
  double t = 0;
  for (int n = 0; n < kMostLayers; ++n) {
    const auto hit = bones_[bone].closest(origin + t * dir, dir, most - t);
    if (!hit) return std::nullopt;
    t += hit->t;
    if (!left_out(changed_[bone], origin + t * dir)) return t;
    t += kOn_m / dir.norm();
  }
  return std::nullopt;
}

void Picker::set_cubes(std::size_t bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes) {
  if (bone >= bones_.size() || cubes.empty() || !(grid.side_m > 0) || !is_finite(grid.lo_B)) return;
  std::uint64_t all = 1;
  for (const int n : grid.count) all = n > 0 ? all * static_cast<std::uint64_t>(n) : 0;
  if (all == 0 || all > kMostPickedCubes) return;
  Changed& changed = changed_[bone];
  if (changed.is.empty() || !same_grid(changed.grid, grid)) {
    changed = {grid, {}, {}};
    changed.is.assign(all, 0);
  }
  for (const SurfaceCube& cube : cubes) {
    if (cube.cube >= all) continue;
    changed.is[cube.cube] = 1;
    changed.cubes.erase(cube.cube);
    if (cube.triangles.empty()) continue;
    Cube& now = changed.cubes[cube.cube];
    now.vertices = cube.vertices;
    now.triangles = cube.triangles;
    for (const Vec3& v : now.vertices) now.box.include(v);
  }
}

void Picker::clear_cubes() {
  for (Changed& changed : changed_) changed = {};
}

Picker::Picker(const Case& the_case) : changed_(the_case.bones.size()) {
  for (const Bone& bone : the_case.bones)
    bones_.emplace_back(bone.mesh.vertices, bone.mesh.triangles);
}

SurfacePoint Picker::pick(const RenderSnapshot& snapshot, const ViewState& view,
                          const Ray& ray) const {
  SurfacePoint best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < bones_.size(); ++k) {
    if (!is_shown(snapshot, view, k)) continue;
    const Pose X_BW = snapshot.bones.bones[k].X_WB.inverse();
    const Vec3 origin = X_BW * ray.origin_W, dir = X_BW.rotate(ray.dir_W);
    auto hit = hit_base(k, origin, dir, nearest);
    for (const auto& [index, cube] : changed_[k].cubes) {
      if (!meets(cube.box, origin, dir)) continue;
      const auto there =
          RayBvh(cube.vertices, cube.triangles).closest(origin, dir, hit.value_or(nearest));
      if (there) hit = there->t;
    }
    if (!hit) continue;
    nearest = *hit;
    best.bone.index = static_cast<std::uint32_t>(k);
    best.p_W = ray.origin_W + *hit * ray.dir_W;
  }
  return best;
}

void Picker::set_surface(std::size_t bone, const TriMesh& mesh_B) {
  if (bone < bones_.size()) bones_[bone] = RayBvh(mesh_B.vertices, mesh_B.triangles);
}

}  // namespace osteon
