#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/device/chatter.h"

namespace osteon {

struct PassivityParams {
  bool on = true;
  double max_damping_n_s_per_m = 8;   ///< that the controller may inject
  double rest_speed_m_per_s = 0.002;  ///< slower than this it injects none: alpha ~ 1 / v^2
  double forget_s = 0.2;              ///< energy owed fades so, once nothing is touched
  ChatterParams chatter;
  bool lower_stiffness = true;       ///< where chatter does not die down
  double kept_share = 0.8;           ///< of the force after a swing that stayed as large as before
  double least_share = 0.02;         ///< of the force that is always passed on
  double recover_after_s = 0.5;      ///< without force
  double recover_share_per_s = 0.5;  ///< from then on
};

/// For the window: what the passivity stage sees and does.
struct PassivityState {
  double energy_j = 0;           ///< that the hand has put in and not got back; below 0: owed
  double damping_n_s_per_m = 0;  ///< injected in the last tick
  double stiffness_share = 1;    ///< of the simulation's force that is passed on
  std::uint64_t lowered = 0;     ///< how often that share was lowered
};

/// Keeps the loop of hand, device and simulation from feeding itself.
///
/// Observer: E -= f . dx with the force that acted over dx (exact for a force held between ticks;
/// Stramigioli and others, IEEE T-RO 2005). Controller: while E < 0, damping alpha = -E / (dt v^2),
/// bounded, none near v = 0 (Hannaford and Ryu, IEEE T-RA 2002). Both see only what passes through
/// this port: a force that reaches the hand late makes energy behind it, and damping that comes
/// late cannot take it out. So chatter is watched for as well, and each swing or bounce that does
/// not die down lowers the share of the simulation's force that is passed on, which is its
/// stiffness, until they do. The share rises again once nothing is touched.
class PassivityControl {
 public:
  explicit PassivityControl(const PassivityParams& params) : params_(params) {}
  /// Starts the account anew.
  void restart();
  /// Force to pass on instead of `force_V`, with the hand at `p_V` moving at `v_V`, all finite.
  Vec3 control(const Vec3& force_V, const Vec3& p_V, const Vec3& v_V, double dt_s);
  /// What really went to the motors.
  void delivered(const Vec3& force_V) { delivered_V_ = force_V; }
  const PassivityState& state() const { return state_; }

 private:
  void observe(const Vec3& p_V, bool free, double dt_s);
  void adapt(const Vec3& force_V, const Vec3& p_V, const Vec3& v_V, double dt_s);
  double damping(const Vec3& v_V, double dt_s) const;

  PassivityParams params_;
  PassivityState state_;
  std::array<SwingWatch, 3> swings_;
  BounceWatch bounces_;
  Vec3 delivered_V_ = Vec3::Zero();
  Vec3 last_p_V_ = Vec3::Zero();
  bool started_ = false;
  double free_s_ = 0;
};

}  // namespace osteon
