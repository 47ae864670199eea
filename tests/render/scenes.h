#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "osteon/base/types.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "surface/shapes.h"

namespace osteon {

/// Sphere of the given radius about the frame's origin.
inline TriMesh sphere_mesh(double radius_m) {
  TriMesh mesh = ball(48, 96);
  for (Vec3& p : mesh.vertices) p *= radius_m;
  return mesh;
}

/// Axis-aligned cube as a hull; each face is one facet of two triangles.
inline Hull cube_hull(double half_m) {
  Hull hull;
  for (int k = 0; k < 8; ++k)
    hull.vertices.emplace_back(k & 1 ? half_m : -half_m, k & 2 ? half_m : -half_m,
                               k & 4 ? half_m : -half_m);
  hull.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (const Vec3& n : {Vec3(-Vec3::UnitZ()), Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitY()),
                        Vec3(Vec3::UnitY()), Vec3(-Vec3::UnitX()), Vec3(Vec3::UnitX())}) {
    hull.plane_of.push_back(static_cast<std::uint32_t>(hull.planes.size()));
    hull.plane_of.push_back(static_cast<std::uint32_t>(hull.planes.size()));
    hull.planes.push_back({n, half_m});
  }
  return hull;
}

inline Bone make_bone(std::string name, TriMesh mesh, const Vec3& p_WB) {
  Bone bone;
  bone.name = std::move(name);
  bone.mesh = std::move(mesh);
  bone.X_WB.p = p_WB;
  return bone;
}

/// A cube of a surface in which a ball about the origin stands, `depth_m` under what was there.
inline SurfaceCube cube_with_ball(double radius_m, float depth_m) {
  SurfaceCube cube;
  TriMesh ball_mesh = sphere_mesh(radius_m);
  cube.vertices = std::move(ball_mesh.vertices);
  for (const Vec3& v : cube.vertices) cube.normals.push_back(v.normalized());
  cube.depth_m.assign(cube.vertices.size(), depth_m);
  cube.triangles = std::move(ball_mesh.triangles);
  return cube;
}

inline Case one_ball(double radius_m, const Vec3& p_WB = Vec3::Zero()) {
  Case one;
  one.bones.push_back(make_bone("ball", sphere_mesh(radius_m), p_WB));
  return one;
}

/// Every bone where the case has it; the tool far outside the picture, so that nothing but bones
/// shows.
inline RenderSnapshot at_rest(const Case& the_case) {
  RenderSnapshot snapshot;
  snapshot.bones.count = static_cast<std::uint32_t>(the_case.bones.size());
  for (std::size_t k = 0; k < the_case.bones.size(); ++k)
    snapshot.bones.bones[k].X_WB = the_case.bones[k].X_WB;
  return snapshot;
}

/// A right hand of balls, fingers along `distal`, back of the hand along `dorsal`.
inline Case ball_hand(const Vec3& distal, const Vec3& dorsal, const Vec3& radial) {
  const auto at = [&](double u, double v, double w) {
    return Vec3(u * distal + v * dorsal + w * radial);
  };
  Case hand;
  TriMesh ball_mesh = sphere_mesh(0.004);
  hand.bones.push_back(make_bone("radius", ball_mesh, at(-0.04, 0, 0.010)));
  hand.bones.push_back(make_bone("ulna", ball_mesh, at(-0.04, 0, -0.012)));
  hand.bones.push_back(make_bone("triquetrum", ball_mesh, at(0, 0.001, -0.011)));
  hand.bones.push_back(make_bone("pisiform", ball_mesh, at(0.001, -0.008, -0.013)));
  hand.bones.push_back(make_bone("scaphoid", ball_mesh, at(0, 0, 0.010)));
  hand.bones.push_back(make_bone("metacarpal_3", ball_mesh, at(0.05, 0.002, 0.010)));
  return hand;
}

}  // namespace osteon
