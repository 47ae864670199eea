#pragma once

#include <memory>
#include <optional>

#include "osteon/scene/placing.h"
#include "ring_box.h"

namespace osteon::testing {

/// Two blocks for the bones: the femur's tunnel along x from its mouth at 0 to 40 mm, the tibia's
/// along z from -30 to -70 mm; no holes, which only pictures would show. `fields`: felt as fields.
inline CaseDef placing_def(bool fields = false) {
  CaseDef def;
  def.name = "placing";
  def.bones.push_back(block_at("femur", {0, -0.02, -0.02}, {0.040, 0.02, 0.02}));
  def.bones.push_back(block_at("tibia", {-0.02, -0.02, -0.070}, {0.02, 0.02, -0.030}));
  if (fields)
    for (BoneDef& bone : def.bones) bone.felt = Felt::kField;
  const auto mark = [&](const char* name, double x, double y, double z = 0) {
    def.landmarks.push_back({name, Vec3(0.001 * x, 0.001 * y, 0.001 * z)});
  };
  mark("femoral_tunnel_from", -9, 0);
  mark("femoral_tunnel_socket", 26, 0);
  mark("femoral_tunnel_to", 62, 0);
  mark("femoral_tunnel_side", -9, 4);
  mark("tibial_tunnel_from", 0, 0, -80);
  mark("tibial_tunnel_to", 0, 0, -22);
  mark("tibial_tunnel_side", 0, 4, -80);
  return def;
}

/// Makes the tibia turn about the femur's origin, 0.1 rad every 30 degrees up to 120, at rest
/// at 90.
inline void let_bend(CaseDef& def, std::optional<double> begin_deg = {}) {
  JointDef knee;
  knee.name = "flexion";
  knee.fixed = "femur";
  knee.at_deg = 90;
  knee.begin_deg = begin_deg;
  PoseTrack track{0, 30, {}};
  const Pose rest = def.bones[0].X_WB.inverse() * def.bones[1].X_WB;
  for (int n = 0; n <= 4; ++n)
    track.poses.push_back(
        Pose{Vec3::Zero(), Quat(Eigen::AngleAxisd(0.1 * (3 - n), Vec3::UnitY()))} * rest);
  knee.bones.push_back({"tibia", track});
  def.joints.push_back(knee);
}

inline std::shared_ptr<const Case> placing_knee(bool fields = false) {
  auto built = build_case(placing_def(fields));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

}  // namespace osteon::testing
