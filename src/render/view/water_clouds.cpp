// Symbols: u a place of the tile, each coordinate in [0, 1). Value noise of n cells: a hash at each
// of n^3 corners, taken modulo n so that the tile repeats, and smooth steps between them. The sizes
// of cells are 5.9 mm (n = 8) and 2.1 mm (n = 22), bent by up to 4 mm with cells of 6.7 mm (n = 7).
#include "view/water_clouds.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/types.h"

namespace osteon {
namespace {

double cloud_hash(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu ^ seed * 0x9e3779b9u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<double>(h ^ (h >> 15)) / 4294967295.0;
}

double smooth_between(double a, double b, double t) { return a + (b - a) * t * t * (3 - 2 * t); }

double tiled_noise(const Vec3& u, int cells, std::uint32_t seed) {
  int low[3], high[3];
  double t[3];
  for (int k = 0; k < 3; ++k) {
    const double at = u[k] * cells, floor = std::floor(at);
    t[k] = at - floor;
    low[k] = ((static_cast<int>(floor) % cells) + cells) % cells;
    high[k] = (low[k] + 1) % cells;
  }
  const auto along_x = [&](int y, int z) {
    return smooth_between(cloud_hash(low[0], y, z, seed), cloud_hash(high[0], y, z, seed), t[0]);
  };
  return smooth_between(smooth_between(along_x(low[1], low[2]), along_x(high[1], low[2]), t[1]),
                        smooth_between(along_x(low[1], high[2]), along_x(high[1], high[2]), t[1]),
                        t[2]);
}

}  // namespace

std::vector<std::uint8_t> water_clouds(int side) {
  constexpr double kBent = 0.004 / kCloudTile_m;
  std::vector<std::uint8_t> values;
  values.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
                 static_cast<std::size_t>(side));
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        Vec3 u = Vec3(x, y, z) / side;
        u += kBent * Vec3(tiled_noise(u, 7, 1), tiled_noise(u, 7, 2), tiled_noise(u, 7, 3));
        const double thick =
            0.3 + 1.4 * (0.65 * tiled_noise(u, 8, 4) + 0.35 * tiled_noise(u, 22, 5));
        values.push_back(
            static_cast<std::uint8_t>(std::lround(127.5 * std::clamp(thick, 0.0, 2.0))));
      }
  return values;
}

}  // namespace osteon
