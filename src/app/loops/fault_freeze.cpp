#include "loops/fault_freeze.h"

#include <algorithm>

namespace osteon {

ToolInput FaultFreeze::input(const ToolInput& device, bool fault, double dt_s) {
  if (!begun_) last_ = device;
  begun_ = true;
  if (fault) {
    share_ = 0;
    from_ = last_;
    from_.v_W.setZero();
    from_.w_W.setZero();
    from_.buttons = device.buttons;
    return last_ = from_;
  }
  if (share_ < 1) share_ = std::min(1.0, share_ + std::max(0.0, dt_s) / return_s_);
  if (share_ >= 1) return last_ = device;
  const Vec3 way_W = device.X_WD.p - from_.X_WD.p;
  last_ = device;
  last_.X_WD.p = from_.X_WD.p + share_ * way_W;
  last_.X_WD.q = from_.X_WD.q.slerp(share_, device.X_WD.q).normalized();
  last_.v_W = share_ * device.v_W + way_W / return_s_;
  last_.w_W = share_ * device.w_W;
  return last_;
}

}  // namespace osteon
