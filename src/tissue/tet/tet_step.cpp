#include <algorithm>
#include <cmath>

#include "tet/tet_element.h"
#include "tet/tet_points.h"
#include "tet/tet_precondition.h"

namespace osteon {
namespace {

// Generalized-alpha with rho = 0.8 at the quickest swings (Chung and Hulbert 1993, equations 25 and
// 17, 18).
constexpr double kRho = 0.8;
constexpr double kAlphaM = (2 * kRho - 1) / (kRho + 1), kAlphaF = kRho / (kRho + 1);
constexpr double kGamma = 0.5 - kAlphaM + kAlphaF;
constexpr double kBeta = 0.25 * (1 - kAlphaM + kAlphaF) * (1 - kAlphaM + kAlphaF);

constexpr double kBalance = 1e-7;    // of the forces: what is left over may be this large
constexpr double kRounding = 1e-13;  // strain that rounding alone makes, with room

using Vectors = std::vector<Vec3>;

Vectors to_vectors(const SolidState::Field& field) {
  Vectors out(field[0].size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {field[0][i], field[1][i], field[2][i]};
  return out;
}

SolidState::Field to_field(const Vectors& v) {
  SolidState::Field out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k].resize(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) out[k][i] = v[i][static_cast<Eigen::Index>(k)];
  }
  return out;
}

double dot(const Vectors& a, const Vectors& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

void add(Vectors& to, double factor, const Vectors& v) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * v[i];
}

AxisMask mask_of(const TetSolid& solid, const Supports& supports) {
  AxisMask mask(solid.rest_W.size(), {false, false, false});
  for (const HeldAxis& h : supports.held) mask[h.slot][h.axis] = true;
  return mask;
}

// Forces that rounding makes where there are none, over all nodes.
double rounding_force_n(const TetSolid& solid) {
  double volume = 0;
  for (const TetElement& e : solid.elements) volume += e.volume_m3;
  const double edge = std::cbrt(volume / static_cast<double>(solid.elements.size()));
  const double modulus =
      bulk_modulus_pa(solid.material) + 4.0 / 3 * shear_modulus_pa(solid.material);
  return kRounding * modulus * edge * edge * std::sqrt(static_cast<double>(solid.rest_W.size()));
}

StepWeights weights_for(const SolidMaterial& material, double dt) {
  return {(1 - kAlphaM) + (1 - kAlphaF) * kGamma * dt * material.damping_per_s,
          (1 - kAlphaF) * kBeta * dt * dt};
}

}  // namespace

struct TetStepper::Impl {
  TetSolid solid;
  Supports supports;
  double dt;
  AxisMask held;
  StepWeights weights;
  TetPreconditioner preconditioner;
  TetPointRows points;
  double rounding_n;

  Impl(TetSolid s, Supports p, double step_s)
      : solid(std::move(s)),
        supports(std::move(p)),
        dt(step_s),
        held(mask_of(solid, supports)),
        weights(weights_for(solid.material, dt)),
        preconditioner(solid, held, weights),
        points(solid),
        rounding_n(rounding_force_n(solid)) {}

  Vectors outer_forces(double time_s) const;
  void release(Vectors& v) const;  // held axes to zero
  std::vector<Mat3> node_rotations(const TetPointScratch& scratch) const;
  bool solve(TetPointScratch& scratch, const Vectors& r, double goal, Vectors& x) const;
  void drive(double time_s, Vectors& u, Vectors& v, Vectors& a) const;
  Vectors start_acceleration(const SolidState& state) const;
};

Vectors TetStepper::Impl::outer_forces(double time_s) const {
  Vectors f(solid.rest_W.size());
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = solid.mass_kg[i] * supports.gravity_m_per_s2;
  for (const NodeLoad& load : supports.loads)
    f[load.slot] += smooth_ramp(time_s, load.over_s).share * load.force_n;
  return f;
}

void TetStepper::Impl::release(Vectors& v) const {
  for (const HeldAxis& h : supports.held) v[h.slot][h.axis] = 0;
}

void TetStepper::Impl::drive(double time_s, Vectors& u, Vectors& v, Vectors& a) const {
  for (const HeldAxis& h : supports.held) {
    const Ramp ramp = smooth_ramp(time_s, h.over_s);
    u[h.slot][h.axis] = h.to_m * ramp.share;
    v[h.slot][h.axis] = h.to_m * ramp.per_s;
    a[h.slot][h.axis] = h.to_m * ramp.per_s2;
  }
}

// The identity where an axis is held.
std::vector<Mat3> TetStepper::Impl::node_rotations(const TetPointScratch& scratch) const {
  std::vector<Mat3> out = points.node_rotations(scratch);
  for (const HeldAxis& h : supports.held) out[h.slot] = Mat3::Identity();
  return out;
}

// Conjugate gradients for A x = r from x = 0, until the residual is below `goal`. A is symmetric
// and positive on the free axes, so each round lowers the error in its norm.
bool TetStepper::Impl::solve(TetPointScratch& scratch, const Vectors& r0, double goal,
                             Vectors& x) const {
  constexpr int kMostRounds = 400;
  const std::vector<Mat3> nodes = node_rotations(scratch);
  x.assign(r0.size(), Vec3::Zero());
  Vectors r = r0, p(r.size(), Vec3::Zero()), ap(r.size());
  double before = 0;
  for (int n = 0; n <= kMostRounds; ++n) {
    if (std::sqrt(dot(r, r)) <= goal) return true;
    const Vectors z = preconditioner.solve(r, nodes);
    const double rz = dot(r, z), keep = n > 0 ? rz / before : 0;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + keep * p[i];
    for (std::size_t i = 0; i < p.size(); ++i) ap[i] = weights.mass * solid.mass_kg[i] * p[i];
    points.add_stiffness(p, weights.stiffness, scratch, ap);
    release(ap);
    const double pap = dot(p, ap);
    if (!(pap > 0)) return false;
    add(x, rz / pap, p);
    add(r, -rz / pap, ap);
    before = rz;
  }
  return false;
}

Vectors TetStepper::Impl::start_acceleration(const SolidState& state) const {
  Vectors f = outer_forces(0);
  add_elastic(solid, state.moved_m, rotations(solid, state.moved_m), 1, f);
  release(f);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] /= solid.mass_kg[i];
  return f;
}

TetStepper::TetStepper(TetSolid solid, Supports supports, double step_s)
    : impl_(std::make_unique<Impl>(std::move(solid), std::move(supports), step_s)) {}
TetStepper::~TetStepper() = default;
TetStepper::TetStepper(TetStepper&&) noexcept = default;

const TetSolid& TetStepper::solid() const { return impl_->solid; }
double TetStepper::step_s() const { return impl_->dt; }
SolidState TetStepper::rest_state() const {
  return state_at_rest(impl_->solid.rest_W.size(), true);
}

// Symbols: u, v, a at the start; u1, v1, a1 at the end; primes in between, at alpha.
//   (1 - am) M a1 + am M a + c M v' + f_int(u') = f_out(t'),
//   u1 = u + dt v + dt^2 ((1/2 - beta) a + beta a1),  v1 = v + dt ((1 - gamma) a + gamma a1).
// Newton's method on a1 with the rotations held still while solving. For linear solids
// one round is enough; for corotated ones each round shrinks what is left by the share of the
// stress that turns, and what does not shrink is refused.
bool TetStepper::step(SolidState& state) const {
  constexpr int kMostRounds = 12;
  const Impl& m = *impl_;
  const double dt = m.dt, then_s = static_cast<double>(state.tick + 1) * dt;
  const Vectors u = to_vectors(state.moved_m), v = to_vectors(state.velocity_m_per_s);
  const Vectors a =
      state.tick == 0 ? m.start_acceleration(state) : to_vectors(state.acceleration_m_per_s2);
  const Vectors outer = m.outer_forces(then_s - kAlphaF * dt);
  Vectors a1 = a, u1 = u, v1 = v, between = u;
  TetPointScratch scratch;
  bool balanced = false;
  for (int n = 0; n < kMostRounds && !balanced; ++n) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      u1[i] = u[i] + dt * v[i] + dt * dt * ((0.5 - kBeta) * a[i] + kBeta * a1[i]);
      v1[i] = v[i] + dt * ((1 - kGamma) * a[i] + kGamma * a1[i]);
    }
    m.drive(then_s, u1, v1, a1);
    for (std::size_t i = 0; i < u.size(); ++i) between[i] = (1 - kAlphaF) * u1[i] + kAlphaF * u[i];
    m.points.rotate(between, scratch);
    Vectors elastic(u.size(), Vec3::Zero());
    m.points.add_elastic(between, scratch, elastic);
    Vectors left(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Vec3 pace = (1 - kAlphaF) * v1[i] + kAlphaF * v[i];
      const Vec3 push = (1 - kAlphaM) * a1[i] + kAlphaM * a[i];
      left[i] = outer[i] + elastic[i] -
                m.solid.mass_kg[i] * (push + m.solid.material.damping_per_s * pace);
    }
    // The size of the forces: of what the supports carry too.
    const double size = std::sqrt(dot(outer, outer)) + std::sqrt(dot(left, left)) +
                        std::sqrt(dot(elastic, elastic));
    m.release(left);
    const double over = std::sqrt(dot(left, left));
    if (!std::isfinite(over)) return false;
    const double allowed = kBalance * size + m.rounding_n;
    balanced = over <= allowed;
    if (balanced) break;
    Vectors change;
    const double goal =
        m.solid.corotated ? std::max(0.5 * kBalance * size, 1e-3 * over) : 0.5 * kBalance * size;
    if (!m.solve(scratch, left, goal, change)) return false;
    add(a1, 1, change);
  }
  if (!balanced) return false;
  state.moved_m = to_field(u1);
  state.velocity_m_per_s = to_field(v1);
  state.acceleration_m_per_s2 = to_field(a1);
  ++state.tick;
  return true;
}

SolidEnergy TetStepper::energy(const SolidState& state) const {
  const TetSolid& solid = impl_->solid;
  SolidEnergy sum;
  sum.strain_j = strain_energy_j(solid, state.moved_m, rotations(solid, state.moved_m));
  for (const auto& v : state.velocity_m_per_s)
    for (std::size_t i = 0; i < v.size(); ++i)
      sum.kinetic_j += 0.5 * solid.mass_kg[i] * v[i] * v[i];
  return sum;
}

std::vector<Vec3> TetStepper::reactions(const SolidState& state) const {
  const Impl& m = *impl_;
  std::vector<Vec3> sum(m.supports.entries, Vec3::Zero());
  const double now_s = static_cast<double>(state.tick) * m.dt;
  Vectors f = m.outer_forces(now_s);
  add_elastic(m.solid, state.moved_m, rotations(m.solid, state.moved_m), 1, f);
  for (const HeldAxis& h : m.supports.held) {
    const Ramp ramp = smooth_ramp(now_s, h.over_s);
    const double driven = h.to_m * (ramp.per_s2 + m.solid.material.damping_per_s * ramp.per_s);
    sum[h.entry][h.axis] += m.solid.mass_kg[h.slot] * driven - f[h.slot][h.axis];
  }
  return sum;
}

double fitting_step_s(const TetSolid& solid, const Supports& supports, double time_s) {
  constexpr double kFewest = 200, kMost = 1000, kOfAPeriod = 40, kOfARamp = 20;
  double step_s = time_s / kFewest;
  const double swing = slowest_swing(solid, mask_of(solid, supports), step_s);
  if (swing > 0) step_s = std::min(step_s, 2 * 3.141592653589793 / swing / kOfAPeriod);
  for (const HeldAxis& h : supports.held)
    if (h.over_s > 0) step_s = std::min(step_s, h.over_s / kOfARamp);
  for (const NodeLoad& load : supports.loads)
    if (load.over_s > 0) step_s = std::min(step_s, load.over_s / kOfARamp);
  return std::max(step_s, time_s / kMost);
}

}  // namespace osteon
