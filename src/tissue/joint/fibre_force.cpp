#include "joint/fibre_force.h"

namespace osteon {

FibreForce fibre_force(const JointFibre& fibre, double length_m) {
  if (fibre.pulled_n > 0) return {fibre.pulled_n * length_m, fibre.pulled_n, 0};
  const double e = (length_m - fibre.slack_m) / fibre.slack_m, toe = fibre.toe_strain;
  const double k = fibre.stiffness_n;
  if (e <= 0) return {};
  if (e < 2 * toe)
    return {fibre.slack_m * k * e * e * e / (12 * toe), k * e * e / (4 * toe),
            k * e / (2 * toe * fibre.slack_m)};
  // The integral to 2 toe is k (2 toe)^3 / (12 toe) = 2/3 k toe^2, and that of k (e - toe) goes on.
  const double beyond = e - toe;
  return {fibre.slack_m * k * (toe * toe / 6 + 0.5 * beyond * beyond), k * beyond,
          k / fibre.slack_m};
}

FibreState fibre_state(const JointFibre& fibre, const Pose& X_FT) {
  const double length_m = (X_FT * fibre.to_T - fibre.from_F).norm() + fibre.over_m;
  return {length_m, fibre.slack_m > 0 ? (length_m - fibre.slack_m) / fibre.slack_m : 0,
          fibre_force(fibre, length_m).force_n};
}

}  // namespace osteon
