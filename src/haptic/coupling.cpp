#include "coupling.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/state.h"

namespace osteon {

Vec3 coupling_force(const Coupling& coupling) {
  const Vec3& nhat = coupling.nhat_W;
  const Vec3 spring = coupling.stiffness_n_per_m * coupling.stretch_W;
  // While the proxy glides round an edge, the spring may pull against the new normal: out of bone
  // all the same, since the proxy is outside. The damper has nothing to say there.
  if (spring.dot(nhat) <= 0) return spring;
  const Vec3 v = coupling.v_bone_W - coupling.v_hand_W;
  const Vec3 damped = coupling.sticking ? v : Vec3(v.dot(nhat) * nhat);
  const Vec3 force = spring + coupling.damping_n_s_per_m * damped;
  return force - std::min(0.0, force.dot(nhat)) * nhat;
}

Vec3 limited_force(const Vec3& force, const Vec3& last, const ForceLimits& limits,
                   std::uint32_t& status) {
  if (!std::isfinite(force.squaredNorm())) {
    status |= kTickForceNotFinite;
    return Vec3::Zero();
  }
  Vec3 f = force;
  const double size = f.norm();
  if (size > limits.max_force_n) {
    status |= kTickForceClamped;
    f *= limits.max_force_n / size;
  }
  const Vec3 change = f - last;
  const double jump = change.norm();
  if (jump > limits.max_change_n) {
    status |= kTickForceSlewed;
    f = last + change * (limits.max_change_n / jump);
  }
  // The limit itself may have fallen since the last tick.
  const double slewed = f.norm();
  return slewed > limits.max_force_n ? Vec3(f * (limits.max_force_n / slewed)) : f;
}

}  // namespace osteon
