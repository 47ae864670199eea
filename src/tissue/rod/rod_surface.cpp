#include <array>
#include <cmath>

#include "osteon/tissue/rod.h"

namespace osteon {
namespace {

constexpr std::uint32_t kAround = 12;  // points of a cross section

// Of both segments at a node, halfway.
Quat frame_of_node(std::span<const Quat> R_WS, std::size_t i) {
  if (i == 0) return R_WS.front();
  if (i == R_WS.size()) return R_WS.back();
  Quat sum = R_WS[i - 1];
  const double sign = sum.dot(R_WS[i]) < 0 ? -1 : 1;
  sum.coeffs() += sign * R_WS[i].coeffs();
  sum.normalize();
  return sum;
}

std::array<Vec3, kAround> section_points(double radius_m) {
  std::array<Vec3, kAround> out;
  for (std::size_t k = 0; k < kAround; ++k) {
    const double angle = 2 * 3.141592653589793 * static_cast<double>(k) / kAround;
    out[k] = {radius_m * std::cos(angle), radius_m * std::sin(angle), 0};
  }
  return out;
}

void add_triangle(RodSurface& out, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  out.triangles.insert(out.triangles.end(), {a, b, c});
}

}  // namespace

RodSurface rod_surface(const Rod& rod, std::span<const Vec3> at_W, std::span<const Quat> R_WS) {
  RodSurface out;
  const std::array<Vec3, kAround> section = section_points(rod.radius_m);
  const auto nodes = static_cast<std::uint32_t>(at_W.size());
  for (std::uint32_t i = 0; i < nodes; ++i) {
    const Quat frame = frame_of_node(R_WS, i);
    for (const Vec3& w : section) out.points_W.push_back(at_W[i] + frame * w);
  }
  out.points_W.push_back(at_W.front());
  out.points_W.push_back(at_W.back());
  const std::uint32_t first = nodes * kAround, last = first + 1, top = first - kAround;
  for (std::uint32_t k = 0; k < kAround; ++k) {
    const std::uint32_t next = (k + 1) % kAround;
    add_triangle(out, first, next, k);
    add_triangle(out, last, top + k, top + next);
    for (std::uint32_t i = 0; i + 1 < nodes; ++i) {
      const std::uint32_t a = i * kAround, b = a + kAround;
      add_triangle(out, a + k, a + next, b + next);
      add_triangle(out, a + k, b + next, b + k);
    }
  }
  return out;
}

}  // namespace osteon
