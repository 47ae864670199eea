#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Spring and damper between the proxy and the hand while bone holds the proxy.
struct Coupling {
  double stiffness_n_per_m = 0;
  double damping_n_s_per_m = 0;
  Vec3 stretch_W = Vec3::Zero();  ///< proxy - hand, m
  Vec3 nhat_W = Vec3::UnitZ();    ///< unit, from bone to tool: of the load without friction
  Vec3 v_bone_W = Vec3::Zero();   ///< of the bone at the contact, m/s
  Vec3 v_hand_W = Vec3::Zero();   ///< m/s
  bool sticking = false;          ///< the damper acts in all directions, else along nhat only
};

/// Force on the hand, N: k stretch + b (v_bone - v_hand). The damper never pulls towards the bone:
/// it can take away the spring's part along nhat, no more.
Vec3 coupling_force(const Coupling& coupling);

struct ForceLimits {
  double max_force_n = 0;
  double max_change_n = 0;  ///< in this tick
};

/// Applies the limits to `force`, given the last tick's, and sets TickStatus bits. A force that is
/// not finite becomes zero at once; the peak limit keeps the direction.
Vec3 limited_force(const Vec3& force, const Vec3& last, const ForceLimits& limits,
                   std::uint32_t& status);

}  // namespace osteon
