#include "osteon/haptic/soft_rub.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr double kSlips = 0.95;  // what is left of the lag after a tick of slipping

}  // namespace

// Symbols: n, of the push; z, the lag, across n; s and d, lags that hold and that slide. A damper
// beside the spring keeps a light hand from swinging; it fades as z nears s, so that it does not
// end in a step where it slips.
Vec3 rub(const RubNow& now, SoftRub& state) {
  const double push = now.push_W.norm(), k = now.stiffness_n_per_m;
  const bool usable = push > 0 && now.resting_n > 0 && k > 0 && is_finite(now.way_W);
  if (!usable) {
    state = {};
    return Vec3::Zero();
  }
  const Vec3 n = now.push_W / push;
  const auto across = [&n](const Vec3& v) { return Vec3(v - n.dot(v) * n); };
  const double s = now.resting_n / k, d = std::min(now.sliding_n / k, s);
  const double before = state.lag_W.norm();
  const Vec3 way = across(now.way_W);
  Vec3 z = across(state.lag_W) + way;
  const double size = z.norm();
  const bool held = size <= (state.sliding ? d : s);
  if (!held) z *= std::max(d, std::min(s, state.sliding ? kSlips * before : size)) / size;
  state.lag_W = z;
  state.sliding = !held;
  Vec3 force = -k * z;
  if (held) force -= (1 - size / s) * now.damping_n_s_per_m / now.tick_s * way;
  const double most = force.norm();
  return most > now.resting_n ? Vec3((now.resting_n / most) * force) : force;
}

}  // namespace osteon
