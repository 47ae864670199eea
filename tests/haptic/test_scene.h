#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "osteon/haptic/haptic.h"
#include "osteon/hull/hull.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon::test {

inline Hull hull_of(const std::vector<Vec3>& points) {
  HullOutcome outcome = build_hull(points);
  return std::move(outcome.hull.value());
}

inline Hull box_hull(const Vec3& half, const Vec3& center = Vec3::Zero()) {
  std::vector<Vec3> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        points.push_back(center + half.cwiseProduct(Vec3(x, y, z)));
  return hull_of(points);
}

/// A bone of convex pieces, with a stiff, slippery surface unless told.
inline Bone bone_of(std::vector<Hull> pieces, const Pose& X_WB = {},
                    const Material& material = {1e4, 0, 0}) {
  Bone bone;
  bone.name = "bone";
  bone.X_WB = X_WB;
  for (const Hull& piece : pieces) bone.bodies.push_back(make_convex_body(piece));
  bone.pieces = std::move(pieces);
  bone.material = material;
  return bone;
}

/// A bone felt as the distance field of its mesh.
inline Bone field_bone(TriMesh mesh, const Pose& X_WB = {},
                       const Material& material = {1e4, 0, 0}) {
  Bone bone = bone_of({hull_of(mesh.vertices)}, X_WB, material);
  bone.felt = Felt::kField;
  bone.field = std::make_shared<const DistanceField>(std::move(DistanceField::make(mesh).value()));
  bone.mesh = std::move(mesh);
  return bone;
}

inline Tool tool_of(Hull piece) {
  Tool tool;
  tool.name = "test";
  tool.bodies.push_back(make_convex_body(piece));
  tool.pieces.push_back(std::move(piece));
  return tool;
}

inline HapticParams plain_params() {
  HapticParams params;
  params.damping_n_s_per_m = 0;
  params.max_force_n = 1e3;
  params.max_slew_n_per_s = 1e9;
  return params;
}

/// A haptic loop with its case and tool, driven by positions.
struct Rig {
  std::shared_ptr<const Case> the_case;
  std::shared_ptr<const Tool> tool;
  HapticLoop loop;
  BoneSnapshot bones;
  HapticParams params = plain_params();

  explicit Rig(std::vector<Bone> list, Tool t = make_wrist_probe())
      : the_case(make_case(std::move(list))),
        tool(std::make_shared<Tool>(std::move(t))),
        loop(the_case, tool) {
    bones.count = static_cast<std::uint32_t>(the_case->bones.size());
    for (std::size_t i = 0; i < the_case->bones.size(); ++i)
      bones.bones[i].X_WB = the_case->bones[i].X_WB;
  }

  static std::shared_ptr<const Case> make_case(std::vector<Bone> list) {
    auto out = std::make_shared<Case>();
    out->bones = std::move(list);
    return out;
  }

  const ToolState& at(const Vec3& p_W, const Quat& q = Quat::Identity(),
                      const Vec3& v_W = Vec3::Zero()) {
    ToolInput input;
    input.X_WD = {p_W, q};
    input.v_W = v_W;
    return loop.tick(input, bones, 0, params);
  }
};

/// Top face at z = 0, 40 x 40 x 10 mm.
inline Bone floor_bone(const Material& material = {1e4, 0, 0}) {
  return bone_of({box_hull(Vec3(0.02, 0.02, 0.005), Vec3(0, 0, -0.005))}, {}, material);
}

/// How far the tip reaches below its origin.
inline double tip_reach(const Rig& rig, const Vec3& direction = -Vec3::UnitZ()) {
  return support(rig.tool->bodies.front(), direction);
}

/// Goes straight from `from` to `to` in equal steps.
inline const ToolState& go(Rig& rig, const Vec3& from, const Vec3& to, int steps) {
  const ToolState* out = nullptr;
  for (int i = 1; i <= steps; ++i) out = &rig.at(from + (to - from) * (double(i) / steps));
  return *out;
}

/// Floor, and walls at x = 2 mm and y = 2 mm.
inline std::vector<Bone> room(int walls) {
  std::vector<Bone> bones{floor_bone()};
  if (walls > 0) bones.push_back(bone_of({box_hull(Vec3(0.005, 0.02, 0.02), Vec3(0.007, 0, 0.0))}));
  if (walls > 1) bones.push_back(bone_of({box_hull(Vec3(0.02, 0.005, 0.02), Vec3(0, 0.007, 0.0))}));
  return bones;
}

/// Largest gap between two hulls over the axes of the separating-axis theorem (facet normals of
/// both, cross products of their edges): > 0 apart, < 0 overlapping. Complete for polytopes, and
/// shares no code with the contact programme.
inline double sat_gap(const Hull& a, const Pose& X_WA, const Hull& b, const Pose& X_WB) {
  const auto placed = [](const Hull& hull, const Pose& X) {
    std::vector<Vec3> out;
    for (const Vec3& v : hull.vertices) out.push_back(X * v);
    return out;
  };
  const std::vector<Vec3> va = placed(a, X_WA);
  const std::vector<Vec3> vb = placed(b, X_WB);
  double best = -1e300;
  const auto try_axis = [&](Vec3 n) {
    const double size = n.norm();
    if (size < 1e-12) return;
    n /= size;
    double lo_a = 1e300, hi_a = -1e300, lo_b = 1e300, hi_b = -1e300;
    for (const Vec3& v : va) {
      lo_a = std::min(lo_a, n.dot(v));
      hi_a = std::max(hi_a, n.dot(v));
    }
    for (const Vec3& v : vb) {
      lo_b = std::min(lo_b, n.dot(v));
      hi_b = std::max(hi_b, n.dot(v));
    }
    best = std::max({best, lo_b - hi_a, lo_a - hi_b});
  };
  for (const Plane& p : a.planes) try_axis(X_WA.rotate(p.n));
  for (const Plane& p : b.planes) try_axis(X_WB.rotate(p.n));
  // Directions of the edges, each once.
  const auto edges = [](const Hull& hull, const std::vector<Vec3>& v) {
    std::vector<Vec3> out;
    for (const Triangle& t : hull.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 e = (v[t[(i + 1) % 3]] - v[t[i]]).normalized();
        const auto same = [&](const Vec3& o) { return std::abs(o.dot(e)) > 1 - 1e-14; };
        if (t[i] < t[(i + 1) % 3] && std::none_of(out.begin(), out.end(), same)) out.push_back(e);
      }
    return out;
  };
  const auto ea = edges(a, va);
  const auto eb = edges(b, vb);
  for (const Vec3& x : ea)
    for (const Vec3& y : eb) try_axis(x.cross(y));
  return best;
}

/// Smallest gap between the proxy and any piece of any bone; of pieces farther than 1 mm, that of
/// their bounding balls.
inline double proxy_gap(const Rig& rig, const ToolState& state) {
  double smallest = 1e300;
  for (std::size_t i = 0; i < rig.the_case->bones.size(); ++i)
    for (const Hull& piece : rig.the_case->bones[i].pieces)
      for (const Hull& tip : rig.tool->pieces)
        smallest = std::min(smallest, sat_gap(piece, rig.bones.bones[i].X_WB, tip, state.X_WP));
  return smallest;
}

}  // namespace osteon::test
