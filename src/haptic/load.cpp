#include "load.h"

#include <algorithm>

#include "rigid_motion.h"

namespace osteon {
namespace {

// Steel on steel: without friction, as stiff as the coupling goes, moving as both hands do.
void add_tool(const HoldingPlane& plane, const LoadScene& scene, Load& out) {
  const double w = plane.weight;
  out.sum += w;
  out.stretch_W += w * plane.nhat_BT_W;
  out.stiffness += w * scene.params.stiffness_n_per_m;
  out.v_bone_W += w * 0.5 * (scene.v_hand_W + scene.others[plane.other].v_W);
  out.by_tool = out.by_tool || w > 0;
}

}  // namespace

Load load_of(const ProxyMove& move, const LoadScene& scene) {
  Load out;
  double largest = 0;
  for (std::uint32_t i = 0; i < move.holding_count; ++i) {
    const HoldingPlane& plane = move.holding[i];
    if (plane.other < kMaxHands) {
      add_tool(plane, scene, out);
      continue;
    }
    const std::uint32_t bone = scene.field.pairs()[plane.pair].bone;
    const Material& material = scene.field.bone(bone).material;
    const double w = plane.weight;
    out.sum += w;
    out.stretch_W += w * plane.nhat_BT_W;
    out.stiffness += w * std::min(scene.params.stiffness_n_per_m, material.stiffness_n_per_m);
    out.static_lag += w * scene.params.friction_scale * material.static_friction;
    out.dynamic_lag += w * scene.params.friction_scale * material.dynamic_friction;
    out.v_bone_W += w * velocity_at(scene.motion[bone], plane.p_W);
    if (w > largest) {
      largest = w;
      out.carrier = BoneId{bone};
    }
  }
  if (!(out.sum > 0)) return out;
  out.stiffness /= out.sum;
  out.v_bone_W /= out.sum;
  const double size = out.stretch_W.norm();
  if (size > 0) out.nhat_W = out.stretch_W / size;
  return out;
}

}  // namespace osteon
