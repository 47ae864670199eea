// The locus of black bodies by Kim et al. (US patent 7024034, 2006); the camera scales its three
// channels so that the light that it was balanced to is white.
#include "osteon/render/white_balance.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

const Vec3 kLuminance(0.2126, 0.7152, 0.0722);

double chromaticity_x(double t) {
  return t < 4000 ? ((-0.2661239e9 / t - 0.2343589e6) / t + 0.8776956e3) / t + 0.179910
                  : ((-3.0258469e9 / t + 2.1070379e6) / t + 0.2226347e3) / t + 0.240390;
}

double chromaticity_y(double t, double x) {
  if (t < 2222) return ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
  if (t < 4000) return ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
  return ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
}

Vec3 unit_luminance(const Vec3& rgb) { return rgb / kLuminance.dot(rgb); }

}  // namespace

Vec3 light_color(double kelvin) {
  const double t =
      std::isfinite(kelvin) ? std::clamp(kelvin, kLeastLamp_k, kMostLamp_k) : kScopeLamp_k;
  const double x = chromaticity_x(t), y = chromaticity_y(t, x);
  const Vec3 xyz(x / y, 1, (1 - x - y) / y);
  Mat3 rgb_from_xyz;  // IEC 61966-2-1
  rgb_from_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  return unit_luminance((rgb_from_xyz * xyz).cwiseMax(0));
}

Vec3 shown_white(const WhiteBalance& white) {
  // A camera's gain is bounded: of the warmest light there is hardly any blue.
  constexpr double kLeast = 0.02;
  const Vec3 light = light_color(white.light_k).cwiseMax(kLeast);
  const Vec3 balance = light_color(white.balance_k).cwiseMax(kLeast);
  return unit_luminance(light.cwiseQuotient(balance));
}

}  // namespace osteon
