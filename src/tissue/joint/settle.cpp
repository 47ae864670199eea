#include <cmath>
#include <optional>
#include <string>

#include "joint/joint_energy.h"

namespace osteon {
namespace {

constexpr double kBalanced_n = 0.01;     // where to stop
constexpr double kNearBalanced_n = 0.1;  // where cartilage has a fold it may get no nearer
constexpr double kLongestStep_m = 0.003;
constexpr int kMostRounds = 400;
constexpr double kLeastDamping = 1e-3, kMostDamping = 1e15;  // N/m

/// Solves A x = b by Cholesky's factors; none where A is not positive definite. Written out, so
/// that sums have one order.
std::optional<JointVector> solve_definite(JointMatrix A, JointVector b) {
  for (int j = 0; j < 5; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < 5; ++i) A(i, j) -= A(i, k) * A(j, k);
    if (!(A(j, j) > 1e-9)) return std::nullopt;
    const double root = std::sqrt(A(j, j));
    for (int i = j; i < 5; ++i) A(i, j) /= root;
  }
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= A(i, k) * b[k];
    b[i] /= A(i, i);
  }
  for (int i = 4; i >= 0; --i) {
    for (int k = i + 1; k < 5; ++k) b[i] -= A(k, i) * b[k];
    b[i] /= A(i, i);
  }
  return b;
}

bool is_sound(const JointFibre& f) {
  return f.from_F.allFinite() && f.to_T.allFinite() && std::isfinite(f.over_m) && f.over_m >= 0 &&
         std::isfinite(f.stiffness_n) && f.stiffness_n >= 0 && std::isfinite(f.pulled_n) &&
         (f.pulled_n > 0 || (std::isfinite(f.slack_m) && f.slack_m > 0 && f.toe_strain > 0));
}

bool is_sound(const JointBed& b) {
  return b.base_T.allFinite() && std::isfinite(b.thickness_m) && std::isfinite(b.stiffness_n_per_m);
}

bool is_sound(const JointPose& p) {
  return p.middle_F.allFinite() && std::isfinite(p.flexion_rad + p.varus_rad + p.internal_rad);
}

Result<void> check(const HeldJoint& joint, const JointLoad& load, const JointPose& start) {
  bool held = false;
  for (std::size_t i = 0; i < joint.fibres.size(); ++i) {
    const JointFibre& f = joint.fibres[i];
    if (!is_sound(f))
      return fail("has a number that is not finite or not above 0", "fibre " + std::to_string(i));
    held = held || f.stiffness_n > 0 || f.pulled_n > 0;
  }
  for (std::size_t i = 0; i < joint.beds.size(); ++i)
    if (!is_sound(joint.beds[i]))
      return fail("has a number that is not finite", "bed of cartilage " + std::to_string(i));
  if (!load.force_F.allFinite() || !std::isfinite(load.varus_nm + load.internal_nm))
    return fail("is not a finite force", "load");
  if (!is_sound(start)) return fail("is not finite", "pose to start from");
  if (!held)
    return fail("nothing holds the tibia", "ligaments",
                "Leave at least one ligament intact, or put in a graft");
  return {};
}

/// One try: the step that the damped curvature gives, no longer than the longest.
std::optional<JointVector> damped_step(const JointEnergy& now, double damping) {
  const JointMatrix A = now.curvature + damping * JointMatrix::Identity();
  auto step = solve_definite(A, -now.slope);
  if (!step || !step->allFinite()) return std::nullopt;
  if (const double length = step->norm(); length > kLongestStep_m) *step *= kLongestStep_m / length;
  return step;
}

}  // namespace

Result<SettledJoint> settle(const HeldJoint& joint, const JointLoad& load, const JointPose& start) {
  // q: place and turns; E(q): energy of fibres, cartilage, surroundings and load, with slope g and
  // curvature H. Levenberg's and Marquardt's step (H + d I) s = -g, d raised until H + d I is
  // definite and E falls, lowered after. Invariant: E never rises. It ends: each round either takes
  // a step or raises d fourfold, which stops at its most; rounds are counted too.
  if (auto sound = check(joint, load, start); !sound) return tl::unexpected(sound.error());
  JointPotential potential(joint, load);
  SettledJoint out;
  out.pose = start;
  JointEnergy now = potential.at(start);
  double damping = 1e3;
  while (out.rounds < kMostRounds && now.slope.norm() > kBalanced_n && damping < kMostDamping) {
    ++out.rounds;
    const auto step = damped_step(now, damping);
    const JointPose next = step ? moved(out.pose, *step) : out.pose;
    const JointEnergy then = step ? potential.at(next) : now;
    if (step && then.energy_j < now.energy_j) {
      out.pose = next;
      now = then;
      damping = std::max(kLeastDamping, damping / 8);
    } else {
      damping *= 4;
    }
  }
  const Pose X_FT = pose_of(joint, out.pose);
  for (const JointFibre& fibre : joint.fibres) out.fibres.push_back(fibre_state(fibre, X_FT));
  out.contact_n = now.contact_n;
  out.unbalanced_n = now.slope.norm();
  out.energy_j = now.energy_j;
  out.converged = out.unbalanced_n <= kNearBalanced_n;
  return out;
}

}  // namespace osteon
