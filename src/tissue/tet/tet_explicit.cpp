#include "tet/tet_explicit.h"

#include <cmath>
#include <limits>

#include "hex/hex_element.h"
#include "tet/tet_element.h"

namespace osteon {
namespace {

NodeVectors moved_of(const TetSolid& solid, const TetElement& e, const SolidState& state) {
  NodeVectors u;
  for (std::size_t a = 0; a < solid.nodes_an_element(); ++a) u[a] = state.moved(e.node[a]);
  return u;
}

hex::Deformation<double> deformed(const TetSolid& solid, const TetElement& e,
                                  const std::array<double, 4>& l, const NodeVectors& u) {
  const Mat3 h = gradient(e.slope, slope_weights(solid.order, l, u));
  return hex::deform<double>(h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1),
                             h(2, 2));
}

void all_forces(const TetSolid& solid, const Supports& supports, double time_s,
                const SolidState& state, TetScratch& scratch) {
  scratch.force_n.resize(solid.rest_W.size());
  for (std::size_t i = 0; i < scratch.force_n.size(); ++i)
    scratch.force_n[i] = solid.mass_kg[i] * supports.gravity_m_per_s2;
  for (const NodeLoad& load : supports.loads)
    scratch.force_n[load.slot] += smooth_ramp(time_s, load.over_s).share * load.force_n;
  if (!scratch.points) scratch.points.emplace(solid);
  scratch.moved_m.resize(scratch.force_n.size());
  for (std::size_t i = 0; i < scratch.moved_m.size(); ++i)
    scratch.moved_m[i] = state.moved(static_cast<std::uint32_t>(i));
  scratch.points->add_neo_hookean(scratch.moved_m, scratch.rows, scratch.force_n);
}

double quickest_swing(const TetSolid& solid) {
  constexpr int kRounds = 30;
  constexpr double kShort = 1.1;  // power iteration comes from below
  TetSolid linear = solid;
  linear.corotated = false;
  const SolidState rest = state_at_rest(solid.rest_W.size(), false);
  const std::vector<Mat3> turned = rotations(linear, rest.moved_m);
  std::vector<Vec3> x(solid.rest_W.size()), kx(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = Vec3(1 + 0.37 * static_cast<double>(i % 7), 1 - 0.61 * static_cast<double>(i % 5),
                0.5 - static_cast<double>(i % 2));
  double square = 0;
  for (int n = 0; n < kRounds; ++n) {
    for (Vec3& v : kx) v.setZero();
    add_stiffness(linear, turned, x, 1, kx);
    double size = 0, before = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      kx[i] /= solid.mass_kg[i];
      size += solid.mass_kg[i] * kx[i].squaredNorm();
      before += solid.mass_kg[i] * x[i].squaredNorm();
    }
    square = std::sqrt(size / before);
    const double per = 1 / std::sqrt(size);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = per * kx[i];
  }
  return kShort * std::sqrt(square);
}

}  // namespace

double stable_explicit_step_s(const TetSolid& solid) { return 0.6 * 2 / quickest_swing(solid); }

// Leapfrog with damping taken half before and half after; held axes go where they are told.
void explicit_step(const TetSolid& solid, const Supports& supports, double dt, SolidState& state,
                   TetScratch& scratch) {
  all_forces(solid, supports, static_cast<double>(state.tick) * dt, state, scratch);
  const double half = 0.5 * solid.material.damping_per_s * dt;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < solid.rest_W.size(); ++i) {
      double& v = state.velocity_m_per_s[k][i];
      v = ((1 - half) * v +
           dt * (scratch.force_n[i][static_cast<Eigen::Index>(k)] / solid.mass_kg[i])) /
          (1 + half);
      state.moved_m[k][i] += dt * v;
    }
  ++state.tick;
  const double then_s = static_cast<double>(state.tick) * dt;
  for (const HeldAxis& held : supports.held) {
    const double before = smooth_ramp(then_s - dt, held.over_s).share;
    const double now = smooth_ramp(then_s, held.over_s).share;
    state.moved_m[held.axis][held.slot] = held.to_m * now;
    state.velocity_m_per_s[held.axis][held.slot] = held.to_m * (now - before) / dt;
  }
}

SolidEnergy explicit_energy(const TetSolid& solid, const SolidState& state) {
  SolidEnergy sum;
  const TetPoints& points = points_of(solid.order);
  const double mu = shear_modulus_pa(solid.material), bulk = bulk_modulus_pa(solid.material);
  for (const TetElement& e : solid.elements) {
    const NodeVectors u = moved_of(solid, e, state);
    for (std::size_t q = 0; q < points.count; ++q)
      sum.strain_j += e.volume_m3 / static_cast<double>(points.count) *
                      hex::neo_hookean_energy(deformed(solid, e, points.at[q], u), mu, bulk);
  }
  sum.kinetic_j = kinetic_j(state, solid.mass_kg);
  return sum;
}

std::vector<Vec3> explicit_reactions(const TetSolid& solid, const Supports& supports, double dt,
                                     const SolidState& state, TetScratch& scratch) {
  std::vector<Vec3> sum(supports.entries, Vec3::Zero());
  const double now_s = static_cast<double>(state.tick) * dt;
  all_forces(solid, supports, now_s, state, scratch);
  for (const HeldAxis& held : supports.held) {
    const Ramp ramp = smooth_ramp(now_s, held.over_s);
    const double driven = solid.mass_kg[held.slot] * held.to_m *
                          (ramp.per_s2 + solid.material.damping_per_s * ramp.per_s);
    sum[held.entry][held.axis] += driven - scratch.force_n[held.slot][held.axis];
  }
  return sum;
}

std::optional<LostElement> find_squeezed(const TetSolid& solid, const SolidState& state) {
  constexpr double kLeastRatio = 0.05;
  const TetPoints& points = points_of(solid.order);
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    const NodeVectors u = moved_of(solid, e, state);
    for (std::size_t q = 0; q < points.count; ++q) {
      const double j = deformed(solid, e, points.at[q], u).j;
      if (j >= kLeastRatio && j < std::numeric_limits<double>::infinity()) continue;
      return LostElement{i, solid.rest_W[e.node[0]], j};
    }
  }
  return std::nullopt;
}

}  // namespace osteon
