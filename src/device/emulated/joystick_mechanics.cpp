#include "joystick_mechanics.h"

#include <cmath>

namespace osteon {

void JoystickMechanics::set_target(const Pose& wanted_VD, const Vec3& wanted_v_V,
                                   std::uint32_t buttons) {
  if (is_finite(wanted_VD) && is_finite(wanted_v_V))
    target_.publish({wanted_VD, wanted_v_V, buttons, true});
}

void JoystickMechanics::advance(std::int64_t now_ns) {
  const Target& target = target_.read();
  if (target.given && !placed_) {
    hand_.reset(target.X_VD);
    placed_ = true;
  }
  buttons_ = target.buttons;
  while (time_ns_ + kStep_ns <= now_ns) {
    hand_.step(1e-9 * kStep_ns, target.X_VD, target.v_V, force_V_);
    time_ns_ += kStep_ns;
  }
}

double JoystickMechanics::turn_about(const Vec3& axis_V) const {
  const Quat& q = hand_.pose().q;
  return 2 * std::atan2(q.vec().dot(axis_V), q.w());
}

}  // namespace osteon
