#include "tet/tet_smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace osteon {
namespace {

constexpr double kFirstStep = 0.2;  // of the mean edge
constexpr double kSmallestStep = 0.01;
constexpr double kBetter = 1e-6;

/// Axes and diagonals of a cube.
std::array<Vec3, 14> search_directions() {
  std::array<Vec3, 14> out;
  for (Vec3::Index k = 0; k < 3; ++k) {
    out[static_cast<std::size_t>(2 * k)] = Vec3::Unit(k);
    out[static_cast<std::size_t>(2 * k + 1)] = -Vec3::Unit(k);
  }
  const double s = std::sqrt(1.0 / 3);
  for (std::size_t c = 0; c < 8; ++c)
    out[6 + c] = Vec3(c & 1 ? s : -s, c & 2 ? s : -s, c & 4 ? s : -s);
  return out;
}

/// Eight directions across a unit normal.
std::array<Vec3, 8> directions_across(const Vec3& nhat) {
  Vec3::Index least = 0;
  nhat.cwiseAbs().minCoeff(&least);
  const Vec3 u = nhat.cross(Vec3(Vec3::Unit(least))).normalized();
  const Vec3 w = nhat.cross(u);
  const double s = std::sqrt(0.5);
  return {
      u, -u, w, -w, Vec3(s * (u + w)), Vec3(-s * (u + w)), Vec3(s * (u - w)), Vec3(-s * (u - w))};
}

}  // namespace

double VertexMover::mean_edge(std::uint32_t v) const {
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t t : work_.around(v))
    for (const std::uint32_t other : work_.tet(t)) {
      if (other == v) continue;
      sum += (work_.place(other) - work_.place(v)).norm();
      ++count;
    }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

bool VertexMover::move(std::uint32_t v) {
  if (work_.around(v).empty()) return false;
  return work_.on_boundary(v) ? move_along_surface(v) : move_inside(v);
}

template <class Directions, class Land>
Vec3 VertexMover::climb(std::uint32_t v, double worth, const Directions& directions,
                        const Land& land) const {
  const double edge = mean_edge(v);
  Vec3 best = work_.place(v);
  for (double step = kFirstStep * edge; step > kSmallestStep * edge;) {
    bool better = false;
    const Vec3 from = best;
    for (const Vec3& direction : directions) {
      const std::optional<Vec3> p = land(from + step * direction, step, worth);
      if (!p) continue;
      const double there = work_.least_worth_around(v, *p, worth + kBetter);
      if (there <= worth + kBetter) continue;
      worth = there;
      best = *p;
      better = true;
    }
    if (!better) step *= 0.5;
  }
  return best;
}

template <class F>
void VertexMover::each_boundary_face(std::uint32_t v, const F& f) const {
  for (const std::uint32_t t : work_.around(v)) {
    const Tetrahedron& tet = work_.tet(t);
    for (std::size_t face = 0; face < 4; ++face) {
      if (tet[face] == v || work_.across(t, face) != TetWork::kNone) continue;
      const auto& corners = kTetFaces[face];
      f(work_.place(tet[corners[0]]), work_.place(tet[corners[1]]), work_.place(tet[corners[2]]));
    }
  }
}

bool VertexMover::move_inside(std::uint32_t v) {
  static const std::array<Vec3, 14> directions = search_directions();
  const Vec3 home = work_.place(v);
  const Vec3 best = climb(v, work_.least_worth_around(v), directions,
                          [](const Vec3& aim, double, double) { return std::optional(aim); });
  if (best == home) return false;
  work_.move(v, best);
  return true;
}

Vec3 VertexMover::boundary_normal(std::uint32_t v) const {
  Vec3 sum = Vec3::Zero();
  each_boundary_face(
      v, [&](const Vec3& a, const Vec3& b, const Vec3& c) { sum += (b - a).cross(c - a); });
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

double VertexMover::distance(const Vec3& p) { return (project_(p, last_hint_) - p).norm(); }

double VertexMover::sag(std::uint32_t v) {
  double worst = 0;
  each_boundary_face(v, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    worst = std::max(worst, distance((a + b + c) / 3));
  });
  return worst;
}

bool VertexMover::move_along_surface(std::uint32_t v) {
  const Vec3 nhat = boundary_normal(v);
  if (nhat.isZero()) return false;
  const Vec3 home = work_.place(v);
  const auto onto_surface = [&](const Vec3& aim, double step, double worth) -> std::optional<Vec3> {
    // What is no better before it is put onto the surface is hardly better after.
    if (work_.least_worth_around(v, aim, 0.8 * worth) <= 0.8 * worth) return std::nullopt;
    const Vec3 p = project_(aim, hints_[v]);
    if ((p - aim).norm() > step) return std::nullopt;
    return p;
  };
  const Vec3 best = climb(v, work_.least_worth_around(v), directions_across(nhat), onto_surface);
  if (best == home) return false;
  const double sag_before = sag(v);
  work_.move(v, best);
  if (sag(v) <= sag_before + slack_m_) return true;
  work_.move(v, home);
  return false;
}

}  // namespace osteon
