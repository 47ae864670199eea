#include "surface/bone_mottle.h"

#include <cmath>
#include <cstdint>

namespace osteon {
namespace {

/// Value of a lattice point, 0..1 (integer hash after Jarzynski and Olano 2020, "pcg3d").
double lattice(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto a = static_cast<std::uint32_t>(x) * 1664525u + 1013904223u;
  auto b = static_cast<std::uint32_t>(y) * 1664525u + 1013904223u;
  auto c = static_cast<std::uint32_t>(z) * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    a += b * c;
    b += c * a;
    c += a * b;
    a ^= a >> 16;
    b ^= b >> 16;
    c ^= c >> 16;
  }
  return (a >> 8) * (1.0 / 16777216.0);
}

/// Smooth noise, 0..1, with features of about one unit.
double value_noise(const Vec3& p) {
  const Vec3 cell = p.array().floor();
  const Vec3 f = p - cell;
  const Vec3 s = f.array() * f.array() * (3 - 2 * f.array());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const double weight =
        (i ? s.x() : 1 - s.x()) * (j ? s.y() : 1 - s.y()) * (k ? s.z() : 1 - s.z());
    sum += weight * lattice(static_cast<std::int64_t>(cell.x()) + i,
                            static_cast<std::int64_t>(cell.y()) + j,
                            static_cast<std::int64_t>(cell.z()) + k);
  }
  return sum;
}

}  // namespace

double bone_mottle(const Vec3& p_B, std::size_t bone) {
  if (p_B.cwiseAbs().maxCoeff() > 1e3) return 0.5;  // lattice indices stay within 64 bits
  const Vec3 apart = Vec3::Constant(17.3 * static_cast<double>(bone + 1));
  return 0.65 * value_noise(p_B / 0.009 + apart) + 0.35 * value_noise(p_B / 0.0025 + apart);
}

}  // namespace osteon
