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
constexpr double kProbes_m[] = {64e-6, 16e-6, 4e-6, 1e-6};
constexpr double kLess_j = 1e-13;  // a difference of energies that is not rounding

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

struct Descent {
  JointPotential potential;
  JointPose pose;
  JointEnergy now;
  int rounds = 0;
};

// q: place and turns; E(q): energy of fibres, cartilage, surroundings and load, with slope g and
// curvature H. Levenberg's and Marquardt's step (H + d I) s = -g, d raised until H + d I is
// definite and E falls, lowered after. Invariant: E never rises. It ends: each round either takes
// a step or raises d fourfold, which stops at its most; rounds are counted too.
void descend(Descent& at) {
  double damping = 1e3;
  while (at.rounds < kMostRounds && at.now.slope.norm() > kBalanced_n && damping < kMostDamping) {
    ++at.rounds;
    const auto step = damped_step(at.now, damping);
    const JointPose next = step ? moved(at.pose, *step) : at.pose;
    const JointEnergy then = step ? at.potential.at(next) : at.now;
    if (step && then.energy_j < at.now.energy_j) {
      at.pose = next;
      at.now = then;
      damping = std::max(kLeastDamping, damping / 8);
    } else {
      damping *= 4;
    }
  }
}

bool steps_down(Descent& at, const JointVector& step) {
  const JointPose next = moved(at.pose, step);
  const JointEnergy then = at.potential.at(next);
  if (!(then.energy_j < at.now.energy_j - kLess_j)) return false;
  at.pose = next;
  at.now = then;
  return true;
}

// Along an axis or between two of them.
bool steps_down_by(Descent& at, double by_m) {
  for (int i = 0; i < 5; ++i)
    for (const double a : {by_m, -by_m}) {
      JointVector step = JointVector::Zero();
      step[i] = a;
      if (steps_down(at, step)) return true;
      for (int k = 0; k < i; ++k)
        for (const double b : {by_m, -by_m}) {
          step[k] = b;
          if (steps_down(at, step)) return true;
          step[k] = 0;
        }
    }
  return false;
}

// Where the cartilage has a fold, the slope jumps at the pose of least energy, and the descent
// stands still on the fold or beside it. Steps of 64 to 1 um along and between the axes are tried:
// one that lowers E begins the descent anew; where none does the joint rests to 1 um. It ends:
// every turn lowers E, and counts as a round.
bool rests_in_fold(Descent& at) {
  while (at.rounds < kMostRounds) {
    ++at.rounds;
    bool down = false;
    for (const double by_m : kProbes_m) down = down || steps_down_by(at, by_m);
    if (!down) return true;
    descend(at);
    if (at.now.slope.norm() <= kNearBalanced_n) return true;
  }
  return false;
}

}  // namespace

Result<SettledJoint> settle(const HeldJoint& joint, const JointLoad& load, const JointPose& start) {
  if (auto sound = check(joint, load, start); !sound) return tl::unexpected(sound.error());
  Descent at{JointPotential(joint, load), start, {}, 0};
  at.now = at.potential.at(start);
  descend(at);
  SettledJoint out;
  out.converged = at.now.slope.norm() <= kNearBalanced_n || rests_in_fold(at);
  out.pose = at.pose;
  out.rounds = at.rounds;
  const Pose X_FT = pose_of(joint, out.pose);
  for (const JointFibre& fibre : joint.fibres) out.fibres.push_back(fibre_state(fibre, X_FT));
  out.contact_n = at.now.contact_n;
  out.unbalanced_n = at.now.slope.norm();
  out.energy_j = at.now.energy_j;
  return out;
}

}  // namespace osteon
