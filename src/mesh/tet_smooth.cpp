#include "tet_smooth.h"

#include <algorithm>
#include <array>
#include <cmath>

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

bool VertexMover::move_inside(std::uint32_t v) {
  static const std::array<Vec3, 14> directions = search_directions();
  const double edge = mean_edge(v);
  Vec3 best = work_.place(v);
  const double before = work_.least_worth_around(v);
  double worth = before;
  for (double step = kFirstStep * edge; step > kSmallestStep * edge;) {
    bool better = false;
    const Vec3 from = best;
    for (const Vec3& direction : directions) {
      const Vec3 p = from + step * direction;
      const double there = work_.least_worth_around(v, p, worth + kBetter);
      if (there <= worth + kBetter) continue;
      worth = there;
      best = p;
      better = true;
    }
    if (!better) step *= 0.5;
  }
  if (worth <= before + kBetter) return false;
  work_.move(v, best);
  return true;
}

Vec3 VertexMover::boundary_normal(std::uint32_t v) const {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t t : work_.around(v)) {
    const Tetrahedron& tet = work_.tet(t);
    for (std::size_t face = 0; face < 4; ++face) {
      if (tet[face] == v || work_.across(t, face) != TetWork::kNone) continue;
      const Vec3 &a = work_.place(tet[kTetFaces[face][0]]),
                 &b = work_.place(tet[kTetFaces[face][1]]),
                 &c = work_.place(tet[kTetFaces[face][2]]);
      sum += (b - a).cross(c - a);
    }
  }
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

double VertexMover::distance(const Vec3& p) { return (project_(p, last_hint_) - p).norm(); }

double VertexMover::sag(std::uint32_t v) {
  double worst = 0;
  for (const std::uint32_t t : work_.around(v)) {
    const Tetrahedron& tet = work_.tet(t);
    for (std::size_t face = 0; face < 4; ++face) {
      if (tet[face] == v || work_.across(t, face) != TetWork::kNone) continue;
      const Vec3 middle =
          (work_.place(tet[kTetFaces[face][0]]) + work_.place(tet[kTetFaces[face][1]]) +
           work_.place(tet[kTetFaces[face][2]])) /
          3;
      worst = std::max(worst, distance(middle));
    }
  }
  return worst;
}

bool VertexMover::move_along_surface(std::uint32_t v) {
  const Vec3 nhat = boundary_normal(v);
  if (nhat.isZero()) return false;
  const std::array<Vec3, 8> directions = directions_across(nhat);
  const double edge = mean_edge(v);
  const Vec3 home = work_.place(v);
  Vec3 best = home;
  const double before = work_.least_worth_around(v);
  double worth = before;
  for (double step = kFirstStep * edge; step > kSmallestStep * edge;) {
    bool better = false;
    const Vec3 from = best;
    for (const Vec3& direction : directions) {
      const Vec3 aim = from + step * direction;
      // What is no better before it is put onto the surface is hardly better after.
      if (work_.least_worth_around(v, aim, 0.8 * worth) <= 0.8 * worth) continue;
      const Vec3 p = project_(aim, hints_[v]);
      if ((p - aim).norm() > step) continue;
      const double there = work_.least_worth_around(v, p, worth + kBetter);
      if (there <= worth + kBetter) continue;
      worth = there;
      best = p;
      better = true;
    }
    if (!better) step *= 0.5;
  }
  if (worth <= before + kBetter) return false;
  const double sag_before = sag(v);
  work_.move(v, best);
  if (sag(v) <= sag_before + slack_m_) return true;
  work_.move(v, home);
  return false;
}

}  // namespace osteon
