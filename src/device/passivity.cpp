#include "osteon/device/passivity.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kMostEnergy_j = 0.1;  // 8 N into 300 N/m: more was worn off by friction

}  // namespace

void PassivityControl::restart() {
  swings_ = {};
  bounces_ = {};
  started_ = false;
  state_.energy_j = 0;
  state_.damping_n_s_per_m = 0;
  delivered_V_.setZero();
}

void PassivityControl::observe(const Vec3& p_V, bool free, double dt_s) {
  const double work_j = delivered_V_.dot(p_V - last_p_V_);
  // A jump of the reading is no work.
  if (started_ && std::abs(work_j) < kMostEnergy_j) state_.energy_j -= work_j;
  started_ = true;
  last_p_V_ = p_V;
  free_s_ = free ? free_s_ + dt_s : 0;
  // Energy that friction wore off must not pay for a later contact, nor is a debt kept for ever.
  state_.energy_j = std::min(state_.energy_j, free ? 0.0 : kMostEnergy_j);
  if (free) state_.energy_j *= params_.forget_s / (params_.forget_s + dt_s);
}

void PassivityControl::adapt(const Vec3& force_V, const Vec3& p_V, const Vec3& v_V, double dt_s) {
  double growth = bounces_.see(v_V, force_V, dt_s, params_.chatter);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    growth = std::max(growth, swings_[i].see(p_V[k], force_V[k], dt_s, params_.chatter));
  }
  double& share = state_.stiffness_share;
  if (growth > 0) {
    // Twice the swing is four times the energy.
    const double kept = params_.kept_share / std::clamp(growth * growth, 1.0, 4.0);
    share = std::max(params_.least_share, kept * share);
    ++state_.lowered;
  } else if (free_s_ > params_.recover_after_s) {
    share = std::min(1.0, share + params_.recover_share_per_s * dt_s);
  }
}

double PassivityControl::damping(const Vec3& v_V, double dt_s) const {
  const double v2 = v_V.squaredNorm();
  const double rest = params_.rest_speed_m_per_s;
  if (state_.energy_j >= 0 || v2 <= rest * rest) return 0;
  return std::min(params_.max_damping_n_s_per_m, -state_.energy_j / (dt_s * v2));
}

Vec3 PassivityControl::control(const Vec3& force_V, const Vec3& p_V, const Vec3& v_V, double dt_s) {
  if (dt_s <= 0) return state_.stiffness_share * force_V;
  observe(p_V, force_V.norm() < kTouch_n, dt_s);
  if (!params_.on) return force_V;
  if (params_.lower_stiffness) adapt(force_V, p_V, v_V, dt_s);
  state_.damping_n_s_per_m = damping(v_V, dt_s);
  return state_.stiffness_share * force_V - state_.damping_n_s_per_m * v_V;
}

}  // namespace osteon
