#include "knee/graft_bends.h"

#include <cmath>

namespace osteon {
namespace {

double bend_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

GraftBend bend_of_graft(const KneeParts& parts, const AclTunnels& tunnels, double flexion_deg) {
  const FemoralTunnel& femur = *tunnels.femur;
  const TibialTunnel& tibia = *tunnels.tibia;
  const Vec3 mouth_F = parts.place(parts.femur, femur.aperture_W);
  const Vec3 in_F = parts.place(parts.femur, femur.aperture_W + femur.inwards_W) - mouth_F;
  const Pose X_FT = pose_at(parts.X_FT, flexion_deg);
  const Vec3 mouth_T = parts.place(parts.tibia, tibia.aperture_W);
  const Vec3 out_T = mouth_T - parts.place(parts.tibia, tibia.aperture_W + tibia.inwards_W);
  const Vec3 from_F = X_FT * mouth_T;
  const Vec3 out_F = X_FT * Vec3(mouth_T + out_T) - from_F;
  const Vec3 between_F = mouth_F - from_F;
  return GraftBend{flexion_deg, between_F.norm(), bend_between(between_F, in_F),
                   bend_between(out_F, between_F)};
}

Result<GraftBend> graft_bend_at(const CaseDef& def, const AclTunnels& tunnels, double flexion_deg) {
  if (!tunnels.femur || !tunnels.tibia)
    return fail("a graft needs a tunnel in femur and tibia", "case '" + def.name + "'",
                "Drill both");
  const auto parts = find_knee_bones(def);
  if (!parts) return tl::unexpected(parts.error());
  if (!(flexion_deg >= 0 && flexion_deg <= parts->X_FT.last()))
    return fail(std::to_string(flexion_deg) + " degrees are outside of 0 to " +
                    std::to_string(parts->X_FT.last()),
                "flexion of case '" + def.name + "'");
  return bend_of_graft(*parts, tunnels, flexion_deg);
}

}  // namespace osteon
