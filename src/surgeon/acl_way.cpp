#include "acl_way.h"

#include <array>
#include <numbers>

namespace osteon {

ProbePath trembling(const ProbePath& path, double tremor_m, std::uint64_t seed) {
  constexpr double kStep_s = 0.01, kRests_s = 5;
  Random random(seed * 2654435761u + 97);
  std::array<double, 3> hz{}, phase{};
  for (std::size_t k = 0; k < 3; ++k) {
    hz[k] = random.uniform(8, 11);
    phase[k] = random.uniform(0, 2 * std::numbers::pi);
  }
  ProbePath out;
  out.with_instruments = path.with_instruments;
  for (std::size_t i = 0; i < path.samples.size(); ++i) {
    out.samples.push_back(path.samples[i]);
    if (i + 1 == path.samples.size()) break;
    const double begin_s = path.samples[i].time_s, end_s = path.samples[i + 1].time_s;
    const bool rests = path.samples[i].X_WD.p == path.samples[i + 1].X_WD.p;
    if (rests && end_s - begin_s > kRests_s) continue;
    for (int n = 1; begin_s + n * kStep_s < end_s - kStep_s / 2; ++n) {
      PathSample at = path.samples[i];
      at.time_s = begin_s + n * kStep_s;
      const double share = (at.time_s - begin_s) / (end_s - begin_s);
      const Pose &a = path.samples[i].X_WD, &b = path.samples[i + 1].X_WD;
      at.X_WD = {a.p + share * (b.p - a.p), a.q.slerp(share, b.q).normalized()};
      for (std::size_t k = 0; k < 3; ++k)
        at.X_WD.p[static_cast<long>(k)] +=
            tremor_m * std::sin(2 * std::numbers::pi * hz[k] * at.time_s + phase[k]);
      out.samples.push_back(at);
    }
  }
  return out;
}

}  // namespace osteon
