#include "osteon/base/random.h"

#include <cmath>

namespace osteon {

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Random::uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

double Random::normal(double mean, double deviation) {
  for (;;) {
    const double u = uniform(-1, 1);
    const double v = uniform(-1, 1);
    const double s = u * u + v * v;
    if (s > 0 && s < 1) return mean + deviation * u * std::sqrt(-2 * std::log(s) / s);
  }
}

Vec3 Random::direction() {
  for (;;) {
    const double x = uniform(-1, 1);
    const double y = uniform(-1, 1);
    const double z = uniform(-1, 1);
    const double n2 = x * x + y * y + z * z;
    if (n2 > 1e-6 && n2 <= 1) return Vec3(x, y, z) / std::sqrt(n2);
  }
}

Quat Random::rotation() {
  // A uniform point of the 3-sphere, by rejection: no trigonometry, same bits everywhere.
  for (;;) {
    const double w = uniform(-1, 1);
    const double x = uniform(-1, 1);
    const double y = uniform(-1, 1);
    const double z = uniform(-1, 1);
    const double n2 = w * w + x * x + y * y + z * z;
    if (n2 > 1e-6 && n2 <= 1) {
      const double n = std::sqrt(n2);
      return Quat(w / n, x / n, y / n, z / n);
    }
  }
}

}  // namespace osteon
