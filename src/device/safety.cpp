#include "osteon/device/safety.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// A clock that jumps back or is broken lets nothing change.
double usable_time(double dt_s) { return std::isfinite(dt_s) && dt_s > 0 ? dt_s : 0; }

// After a stall the force may not jump by all that the time would allow.
constexpr double kLongestSlew_s = 0.005;

}  // namespace

SafetyGate::SafetyGate(const DeviceInfo& info, const SafetyParams& params, ForceOff cause)
    : info_(info),
      params_(params),
      cause_(cause == ForceOff::kNone ? ForceOff::kSoftware : cause),
      passivity_(params.passivity),
      slew_(info.max_slew_n_per_s),
      budget_(info.peak_force_n, info.continuous_force_n, params.thermal_s),
      torque_(info, params.passivity, params.thermal_s),
      ramp_(params.ramp_in_s, params.stale_after_s, params.stale_decay_s) {}

void SafetyGate::enable() {
  cause_ = ForceOff::kNone;
  slew_.settle(Vec3::Zero());
  ramp_.restart();
  silence_.restart();
  passivity_.restart();
  torque_.restart();
}

void SafetyGate::disable(ForceOff cause) {
  if (cause_ == ForceOff::kNone) cause_ = cause == ForceOff::kNone ? ForceOff::kSoftware : cause;
}

// A device that drives no rotation asks nothing of the torque.
bool SafetyGate::all_finite(const DeviceWrench& wanted, const DeviceSample& sample) const {
  if (!is_finite(wanted.force_V) || !is_finite(sample.v_V) || !is_finite(sample.X_VD)) return false;
  return !torque_.driven() || (is_finite(wanted.torque_V) && is_finite(sample.w_V));
}

// Stages 1, 2, 6 and 8: whatever trips gives zero at once, so that all are asked first.
ForceOff SafetyGate::trip_cause(const DeviceWrench& wanted, const DeviceSample& sample,
                                double age_s) const {
  if (!all_finite(wanted, sample) || std::isnan(age_s)) return ForceOff::kNotFinite;
  if (!sample.connected) return ForceOff::kDisconnect;
  if (sample.refusal != ForceOff::kNone) return sample.refusal;
  if (!sample.calibrated) return ForceOff::kCalibration;
  if (!sample.dead_man_held) return ForceOff::kDeadMan;
  if (sample.v_V.norm() > params_.max_velocity_m_per_s) return ForceOff::kVelocity;
  if (torque_.driven() && sample.w_V.norm() > params_.max_turn_rad_per_s)
    return ForceOff::kVelocity;
  if (ramp_.too_old(age_s)) return ForceOff::kWatchdog;
  if (silence_.silent_s() >= params_.silent_fault_s) return ForceOff::kDisconnect;
  return ForceOff::kNone;
}

// An axis without a motor must eat neither the slew limit nor the peak of the others.
Vec3 SafetyGate::actuated(const Vec3& force_V) const {
  Vec3 f = force_V;
  for (int i = 0; i < 3; ++i)
    if (!info_.force_axes[static_cast<std::size_t>(i)]) f[i] = 0;
  return f;
}

// Stages 3 to 5.
Vec3 SafetyGate::shaped(const Vec3& force_V, const Vec3& assist_V, const DeviceSample& sample,
                        double dt_s) {
  const Vec3 passive =
      passivity_.control(actuated(force_V), sample.X_VD.p, actuated(sample.v_V), dt_s);
  const Vec3 slewed = slew_.next(passive + actuated(assist_V), std::min(dt_s, kLongestSlew_s));
  const Vec3 force = budget_.limited(slewed);
  slew_.settle(force);
  return force;
}

// Stages 7 and 8.
double SafetyGate::allowed_share(double age_s, double dt_s) {
  if (dt_s > params_.stall_s || silence_.silent_s() > params_.silent_zero_s) {
    ramp_.restart();
    return 0;
  }
  return ramp_.advance(age_s, dt_s);
}

DeviceWrench SafetyGate::filter(const DeviceWrench& wanted, const DeviceSample& sample,
                                double age_s, double dt_s, const Vec3& assist_V) {
  const double dt = usable_time(dt_s);
  silence_.see(sample.time_ns, dt);
  const Vec3 assist = is_finite(assist_V) ? assist_V : Vec3::Zero();
  const ForceOff trip = trip_cause(wanted, sample, age_s);
  if (trip != ForceOff::kNone) disable(trip);
  DeviceWrench given;
  if (enabled()) {
    const Vec3 whole = shaped(wanted.force_V, assist, sample, dt);
    const Vec3 turning = torque_.shaped(wanted.torque_V, sample, std::min(dt, kLongestSlew_s));
    const double share = allowed_share(age_s, dt);
    given = {share * whole, share * turning};
    passivity_.delivered(share * (whole - actuated(assist)));
  }
  budget_.spend(given.force_V, dt);  // the motors cool while the force is off
  torque_.spend(given.torque_V, dt);
  return given;
}

SafetyState SafetyGate::state() const {
  return {cause_,         enabled() ? ramp_.gain() : 0, budget_.limit_n(),
          budget_.heat(), passivity_.state(),           torque_.limit_nm(),
          torque_.heat()};
}

}  // namespace osteon
