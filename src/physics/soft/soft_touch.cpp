#include "soft/soft_touch.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kLetGo_s = 0.05;  // as a contact with bone
constexpr double kBackUnder = 0.9;

}  // namespace

TouchNews follow_touch(BandTouch& touch, const TouchNow& now, double limit_n, std::uint64_t step,
                       double step_s) {
  TouchNews news;
  const auto away = static_cast<std::uint64_t>(std::ceil(kLetGo_s / step_s));
  if (now.force_n > 0 && now.felt) {
    news.begins = !touch.on;
    if (news.begins) touch = {true, false, step, step, 0, 0};
    touch.last_step = step;
    touch.peak_n = std::max(touch.peak_n, now.force_n);
    touch.deepest_m = std::max(touch.deepest_m, now.deep_m);
    news.over = now.force_n > limit_n && !touch.over;
    touch.over = now.force_n > limit_n || (touch.over && now.force_n > kBackUnder * limit_n);
  } else if (touch.on && (!now.felt || step > touch.last_step + away)) {
    news.ends = true;
    news.since_s = static_cast<double>(touch.last_step - touch.first_step) * step_s;
    news.peak_n = touch.peak_n;
    news.deepest_mm = 1e3 * touch.deepest_m;
    touch = {};
  }
  return news;
}

}  // namespace osteon
