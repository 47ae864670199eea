#pragma once

#include <cstdint>

#include "osteon/device/haptic_device.h"
#include "osteon/device/passivity.h"
#include "osteon/device/safety_limits.h"
#include "osteon/device/safety_time.h"
#include "osteon/device/torque_stages.h"

namespace osteon {

struct SafetyParams {
  double ramp_in_s = 0.5;             ///< from zero to full force after enabling, fault or stall
  double max_velocity_m_per_s = 1.0;  ///< faster than this trips
  double stale_after_s = 0.020;       ///< simulation silent for so long: force decays
  double stale_decay_s = 0.030;       ///< to zero over this time; then the watchdog trips
  double silent_zero_s = 0.010;       ///< device silent for longer: zero, then ramped in again
  double silent_fault_s = 0.020;      ///< device silent for so long: a fault
  double stall_s = 0.020;             ///< a tick longer than this ramps in again
  double thermal_s = 5.0;             ///< time constant of the motors' heat
  double max_turn_rad_per_s = 30;     ///< faster than this trips a device with driven rotations
  PassivityParams passivity;
};

/// For the window: what the gate sees and does.
struct SafetyState {
  ForceOff cause = ForceOff::kSoftware;
  double gain = 0;     ///< of ramp-in and watchdog, in [0, 1]
  double limit_n = 0;  ///< the peak, or less when the motors are warm
  double heat = 0;     ///< of the motors by the thermal budget: 1 is what they bear for ever
  PassivityState passivity;
  double torque_limit_nm = 0;  ///< as limit_n, of the driven rotations; 0: there are none
  double torque_heat = 0;
};

/// Last gate between a simulation and a driver, in the order of its stages:
///  1. finite: force, reading and age;
///  2. connected, not refused by the device, calibrated, dead-man held;
///  3. passivity observer and controller (device/passivity.h);
///  4. slew, of the actuated axes;
///  5. peak force as a vector, continuous force by the motors' heat;
///  6. over-velocity;
///  7. ramp-in, after enabling and after a stall;
///  8. watchdog on the simulation's data and on the device's silence.
/// A torque goes through stages of its own (device/torque_stages.h) with limits of its own; the
/// trips, the ramp and the watchdog are one for both: what takes the force takes the torque.
/// A trip latches: only `enable` by the user re-arms. Stage 9, zero force at the end of the run, is
/// the caller's. Plain arithmetic on its own state: fit for the haptic tick and for a virtual
/// clock.
class SafetyGate {
 public:
  /// Off at first, for the cause given.
  SafetyGate(const DeviceInfo& info, const SafetyParams& params = {},
             ForceOff cause = ForceOff::kSoftware);
  /// The user's own action; starts the ramp.
  void enable();
  /// Zero force from the next `filter` on. `kNone` counts as kSoftware; the first cause is kept.
  void disable(ForceOff cause);
  /// Ramps in again, without a fault: the force has jumped for a good reason.
  void ramp_in_again() { ramp_.restart(); }
  /// Force that may reach the motors, N, in V. `sample` is the newest reading, `age_s` how old the
  /// simulation's force is, `dt_s` the time since the last call. `assist_V` makes up for the
  /// device's own friction and inertia: it passes by the passivity stage, which would undo it. A
  /// trip gives zero at once.
  Vec3 filter(const Vec3& force_V, const DeviceSample& sample, double age_s, double dt_s,
              const Vec3& assist_V = Vec3::Zero()) {
    return filter(DeviceWrench{force_V, Vec3::Zero()}, sample, age_s, dt_s, assist_V).force_V;
  }
  /// The same with a torque about the stylus' origin. Where the device drives a rotation, a torque
  /// or a rate of turn that is not finite trips as a force does.
  DeviceWrench filter(const DeviceWrench& wanted, const DeviceSample& sample, double age_s,
                      double dt_s, const Vec3& assist_V = Vec3::Zero());
  ForceOff cause() const { return cause_; }
  bool enabled() const { return cause_ == ForceOff::kNone; }
  SafetyState state() const;

 private:
  bool all_finite(const DeviceWrench& wanted, const DeviceSample& sample) const;
  ForceOff trip_cause(const DeviceWrench& wanted, const DeviceSample& sample, double age_s) const;
  Vec3 actuated(const Vec3& force_V) const;
  Vec3 shaped(const Vec3& force_V, const Vec3& assist_V, const DeviceSample& sample, double dt_s);
  double allowed_share(double age_s, double dt_s);

  DeviceInfo info_;
  SafetyParams params_;
  ForceOff cause_ = ForceOff::kSoftware;
  PassivityControl passivity_;
  SlewLimit slew_;
  ForceBudget budget_;
  TorqueStages torque_;
  ForceRamp ramp_;
  SilenceWatch silence_;
};

}  // namespace osteon
