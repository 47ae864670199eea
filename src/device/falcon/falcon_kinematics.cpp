#include "falcon_kinematics.h"

#include <algorithm>
#include <cmath>

#include "angles.h"

namespace osteon::falcon {
namespace {

// Lengths in m, named as in Stamper's figure of one leg.
constexpr double kA = 0.060;     // driven arm
constexpr double kB = 0.1025;    // side of the parallelogram
constexpr double kC = 0.01443;   // grip's middle to the leg, along u
constexpr double kD = 0.01125;   // parallelogram to grip
constexpr double kE = 0.01125;   // arm to parallelogram
constexpr double kF = -0.025;    // grip's middle to the leg, along v
constexpr double kR = 0.0400;    // frame's origin to the driven joint, along u
constexpr double kS = -0.02309;  // the same along v

constexpr double kZeroAngle_deg = 35;
// 360 degrees / (320 slots x 4 edges) x shaft 14.25 mm / arm wheel 110 mm
constexpr double kDegPerCount = 360.0 / (320 * 4) * (0.01425 / 0.110);

// Directions of the legs about z: 90, -30 and -150 degrees, each turned by 15.
struct LegFrame {
  double cos_phi, sin_phi;
};
const std::array<LegFrame, 3>& leg_frames() {
  static const std::array<LegFrame, 3> frames = [] {
    std::array<LegFrame, 3> f{};
    const std::array<double, 3> deg{90 + 15, -30 + 15, -150 + 15};
    for (std::size_t i = 0; i < 3; ++i)
      f[i] = {std::cos(deg[i] * kRadPerDeg), std::sin(deg[i] * kRadPerDeg)};
    return f;
  }();
  return frames;
}

// One leg at one position of the grip. In the leg's frame the arm's end lies at
// (a cos t1, a sin t1) in the plane (u, w), and the parallelogram bridges the rest:
//   u + c - a cos t1 = L cos t2,   w - a sin t1 = L sin t2,
//   v + f = b cos t3,              L = d + e + b sin t3.
struct Leg {
  double u_c;  // u + c
  double w;
  double across;  // v + f
  double lift;    // b sin t3
  double reach;   // L
  double angle;   // t1
};

std::optional<Leg> solve_leg(const LegFrame& frame, const Vec3& p_F) {
  Leg leg{};
  const double u = frame.cos_phi * p_F.x() + frame.sin_phi * p_F.y() - kR;
  const double v = -frame.sin_phi * p_F.x() + frame.cos_phi * p_F.y() - kS;
  leg.u_c = u + kC;
  leg.w = p_F.z();
  leg.across = v + kF;
  const double lift_squared = kB * kB - leg.across * leg.across;
  if (!(lift_squared > 0)) return std::nullopt;
  leg.lift = std::sqrt(lift_squared);
  leg.reach = kD + kE + leg.lift;
  // (u_c - a cos t)^2 + (w - a sin t)^2 = L^2 is h cos(t - direction) = k.
  const double h = std::hypot(leg.u_c, leg.w);
  const double k = (h * h + kA * kA - leg.reach * leg.reach) / (2 * kA);
  if (!(std::abs(k) < h)) return std::nullopt;
  // Of the two bends of the knee the one that the machine has.
  leg.angle = std::atan2(leg.w, leg.u_c) - std::acos(k / h);
  return leg;
}

// d(angle) / d(u, v, w), from the leg's closing equation.
std::optional<Vec3> slope(const Leg& leg) {
  const double cos_t = std::cos(leg.angle);
  const double sin_t = std::sin(leg.angle);
  const double by_angle = kA * (leg.u_c * sin_t - leg.w * cos_t);
  if (!(std::abs(by_angle) > 1e-7)) return std::nullopt;  // arm and parallelogram in one line
  const Vec3 by_uvw(leg.u_c - kA * cos_t, leg.reach * leg.across / leg.lift, leg.w - kA * sin_t);
  return Vec3(-by_uvw / by_angle);
}

}  // namespace

std::optional<Vec3> joint_angles(const Vec3& p_F) {
  Vec3 angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto leg = solve_leg(leg_frames()[i], p_F);
    if (!leg) return std::nullopt;
    angles[static_cast<Eigen::Index>(i)] = leg->angle;
  }
  return angles;
}

std::optional<Mat3> angle_jacobian(const Vec3& p_F) {
  Mat3 J;
  for (std::size_t i = 0; i < 3; ++i) {
    const LegFrame& frame = leg_frames()[i];
    const auto leg = solve_leg(frame, p_F);
    const auto by_uvw = leg ? slope(*leg) : std::nullopt;
    if (!by_uvw) return std::nullopt;
    J.row(static_cast<Eigen::Index>(i))
        << frame.cos_phi * by_uvw->x() - frame.sin_phi * by_uvw->y(),
        frame.sin_phi * by_uvw->x() + frame.cos_phi * by_uvw->y(), by_uvw->z();
  }
  return J;
}

std::optional<Vec3> grip_position(const Vec3& angles, const Vec3& guess_F) {
  constexpr int kMostSteps = 12;
  constexpr double kGood_rad = 1e-12;
  constexpr double kLongestStep_m = 0.03;
  if (!is_finite(angles)) return std::nullopt;
  Vec3 p = guess_F;
  for (int i = 0; i < kMostSteps; ++i) {
    const auto at = joint_angles(p);
    const auto J = angle_jacobian(p);
    if (!at || !J) return std::nullopt;
    const Vec3 missing = angles - *at;
    if (missing.cwiseAbs().maxCoeff() < kGood_rad) return p;
    Vec3 step = J->inverse() * missing;
    if (!is_finite(step)) return std::nullopt;
    if (step.norm() > kLongestStep_m) step *= kLongestStep_m / step.norm();
    p += step;
  }
  return std::nullopt;
}

Vec3 angles_of(const std::array<int, 3>& counts) {
  Vec3 angles;
  for (std::size_t i = 0; i < 3; ++i)
    angles[static_cast<Eigen::Index>(i)] = (kZeroAngle_deg + kDegPerCount * counts[i]) * kRadPerDeg;
  return angles;
}

Vec3 counts_of(const Vec3& angles) {
  return (angles / kRadPerDeg - Vec3::Constant(kZeroAngle_deg)) / kDegPerCount;
}

std::array<int, 3> motor_counts(const Vec3& force_F, const Vec3& p_F) {
  const auto J = angle_jacobian(p_F);
  if (!J || !is_finite(force_F)) return {0, 0, 0};
  const Vec3 torque_nm = J->transpose().inverse() * force_F;
  if (!is_finite(torque_nm)) return {0, 0, 0};
  const Vec3 counts = kCountsPerNm * torque_nm;
  const double largest = counts.cwiseAbs().maxCoeff();
  const double scale = largest > kMotorLimit ? kMotorLimit / largest : 1;
  const auto whole = [&](Eigen::Index i) {
    return static_cast<int>(std::lround(scale * counts[i]));
  };
  return {whole(0), whole(1), whole(2)};
}

}  // namespace osteon::falcon
