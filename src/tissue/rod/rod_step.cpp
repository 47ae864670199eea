#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"
#include "rod/rod_newton.h"

namespace osteon {

struct RodStepper::Impl : rods::RodNewton {
  using rods::RodNewton::RodNewton;
};

RodStepper::RodStepper(Rod rod, RodSupports supports, double step_s)
    : impl_(std::make_unique<Impl>(std::move(rod), std::move(supports), step_s)) {}
RodStepper::~RodStepper() = default;
RodStepper::RodStepper(RodStepper&&) noexcept = default;
RodStepper& RodStepper::operator=(RodStepper&&) noexcept = default;

const Rod& RodStepper::rod() const { return impl_->rod; }
const RodSupports& RodStepper::supports() const { return impl_->supports; }
double RodStepper::step_s() const { return impl_->dt; }

RodState RodStepper::start_state() const {
  RodState out;
  out.at_W = impl_->rod.start_W;
  out.R_WS = impl_->rod.start_R_WS;
  out.velocity_m_per_s.assign(out.at_W.size(), Vec3::Zero());
  out.spin_rad_per_s.assign(out.R_WS.size(), Vec3::Zero());
  out.grip_n.assign(impl_->supports.grips.size(), Vec3::Zero());
  out.grip_n_m = out.grip_n;
  return out;
}

// Parts of a step, so that nothing passes more than half a radius in one and so nothing is passed
// through.
void RodStepper::step(RodState& state) {
  constexpr double kMostParts = 16;
  double quickest = 0;
  for (const Vec3& v : state.velocity_m_per_s) quickest = std::max(quickest, v.squaredNorm());
  const double wanted = std::ceil(std::sqrt(quickest) * impl_->dt / (0.5 * impl_->rod.radius_m));
  const int parts = static_cast<int>(std::clamp(wanted, 1.0, kMostParts));
  const double from_s = static_cast<double>(state.tick) * impl_->dt;
  const double part_s = impl_->dt / parts;
  for (int n = 0; n < parts; ++n) impl_->advance(state, from_s + n * part_s, part_s);
  ++state.tick;
}

SolidEnergy RodStepper::energy(const RodState& state) const {
  const Impl& m = *impl_;
  SolidEnergy sum;
  sum.strain_j = rods::elastic_energy_j(m.rod, m.span, {state.at_W, state.R_WS});
  for (std::size_t i = 0; i < state.at_W.size(); ++i)
    sum.kinetic_j += 0.5 * m.rod.mass_kg[i] * state.velocity_m_per_s[i].squaredNorm();
  for (std::size_t i = 0; i < state.R_WS.size(); ++i) {
    const Vec3& w = state.spin_rad_per_s[i];
    sum.kinetic_j += 0.5 * m.inertia[i] * w.dot(Vec3(1, 1, 2).cwiseProduct(w));
  }
  return sum;
}

std::uint64_t hash_of(const RodState& state) {
  Hasher hash;
  const auto add = [&](const auto& values, auto to_numbers) {
    hash.add(static_cast<std::uint64_t>(values.size()));
    for (const auto& v : values) hash.bytes(to_numbers(v), sizeof(double) * v.size());
  };
  const auto of_vec = [](const Vec3& v) { return v.data(); };
  add(state.at_W, of_vec);
  add(state.velocity_m_per_s, of_vec);
  add(state.spin_rad_per_s, of_vec);
  hash.add(static_cast<std::uint64_t>(state.R_WS.size()));
  for (const Quat& q : state.R_WS) hash.bytes(q.coeffs().data(), 4 * sizeof(double));
  for (const RodStick& s : state.sticks) {
    hash.add(std::uint64_t{s.sample} << 32 | s.other);
    hash.bytes(s.way_m.data(), 3 * sizeof(double));
  }
  hash.add(state.tick);
  return hash.value();
}

double fitting_step_s(const Rod& rod, const RodSupports& supports, double time_s) {
  constexpr double kLongest_s = 1e-3, kFewest = 500, kMost = 2e5, kRampPeak = 1.875;
  double step_s = std::min(kLongest_s, time_s / kFewest);
  for (const RodGrip& grip : supports.grips) {
    const double quickest = kRampPeak * grip.by_m.norm() / std::max(grip.over_s, 1e-9);
    if (quickest > 0) step_s = std::min(step_s, 0.25 * rod.radius_m / quickest);
  }
  return std::max(step_s, time_s / kMost);
}

std::optional<std::size_t> find_lost(const Rod& rod, const RodState& state) {
  for (std::size_t i = 0; i < rod.segments(); ++i) {
    const Vec3 along = state.R_WS[i] * Vec3(0, 0, 1);
    const double share = along.dot(state.at_W[i + 1] - state.at_W[i]) / rod.length_m[i];
    if (!(share >= 0.05 && share < 1e6)) return i;
  }
  return std::nullopt;
}

}  // namespace osteon
