#pragma once

#include <span>

#include "contact_field.h"
#include "osteon/haptic/haptic.h"
#include "proxy_solver.h"

namespace osteon {

/// Load of the planes that hold the proxy, and the material under it.
struct Load {
  Vec3 stretch_W = Vec3::Zero();  // frictionless proxy - hand
  Vec3 nhat_W = Vec3::UnitZ();
  double sum = 0;  // of the planes' weights, m
  double stiffness = 0;
  double static_lag = 0;
  double dynamic_lag = 0;
  Vec3 v_bone_W = Vec3::Zero();
  BoneId carrier;
  bool by_tool = false;  // another hand's tool holds the proxy

  bool holds() const { return carrier.valid() || by_tool; }
};

/// What a load is taken from, as one tick sees it.
struct LoadScene {
  const ContactField& field;
  std::span<const BoneMotion> motion;  ///< of each bone
  const OtherTools& others;
  const Vec3& v_hand_W;
  const HapticParams& params;
};

Load load_of(const ProxyMove& move, const LoadScene& scene);

}  // namespace osteon
