#pragma once

#include <array>
#include <memory>
#include <vector>

#include "osteon/physics/bone_world.h"

namespace osteon::testing {

/// A box as a hull, by hand: center, half sizes, orientation in the bone's frame.
inline Hull box_hull(const Vec3& center, const Vec3& half, const Quat& q = Quat::Identity()) {
  Hull hull;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                      (i & 4) ? half.z() : -half.z());
    hull.vertices.push_back(center + q * corner);
  }
  hull.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  hull.centroid = center;
  hull.volume = 8 * half.x() * half.y() * half.z();
  return hull;
}

/// Bones of one box each. Their frames lie off their centres of mass, as those of a scan do.
inline std::shared_ptr<const Case> box_case(const std::vector<double>& masses_kg) {
  auto the_case = std::make_shared<Case>();
  the_case->name = "boxes";
  for (std::size_t i = 0; i < masses_kg.size(); ++i) {
    Bone bone;
    bone.name = "bone" + std::to_string(i);
    bone.mass_kg = masses_kg[i];
    const double x = static_cast<double>(i);
    bone.X_WB = {Vec3(0.1 * x, 0.2, 0.3), Quat(0.8, 0.2, 0.1 * x, 0.4).normalized()};
    bone.pieces = {box_hull({0.03, -0.02, 0.05}, {0.006, 0.010, 0.015})};
    the_case->bones.push_back(bone);
  }
  return the_case;
}

/// Where a bone's centre of mass lies when the bone is at `X_WB`.
inline Vec3 center_W(const Pose& X_WB) { return X_WB * Vec3(0.03, -0.02, 0.05); }

/// The tool pushes `bone` with `force_on_bone_W` at `p_W`.
inline ToolState push(std::uint32_t bone, const Vec3& p_W, const Vec3& force_on_bone_W) {
  ToolState tool;
  tool.contact_count = 1;
  tool.contacts[0].bone = BoneId{bone};
  tool.contacts[0].p_W = p_W;
  tool.contacts[0].force_on_tool_W = -force_on_bone_W;
  return tool;
}

}  // namespace osteon::testing
