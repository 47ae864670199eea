#include "portal_pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osteon {
namespace {

constexpr double kCapture_m = 0.005;
constexpr double kWithdrawn_m = 0.0005;    // the tip is this far out before the portal lets it go
constexpr double kFarOut_m = 0.005;        // and at the latest here, wherever the hand is
constexpr double kSwing_m = 0.015;         // L0: a shaft so long swings as easily as it is shifted
constexpr double kGripPerTick = 0.02;      // the skin closes about a shaft within 50 ticks
constexpr double kForgetPerTick = 0.0125;  // 80 ticks after it was let go a shaft counts as out
constexpr double kShortestLever_m = 1e-4;

// The shaft's axis beside a portal.
struct Beside {
  Vec3 e_W = Vec3::Zero();      // from the axis to the portal, across the axis
  Vec3 lever_W = Vec3::Zero();  // from the tool's origin to the axis there
  Vec3 along_W = Vec3::UnitZ();
};

Beside beside(const Portal& portal, const Capsule& shaft, const Vec3& p_W, const Quat& q_W) {
  Beside out;
  const Vec3 offset_W = q_W * shaft.p0;
  out.along_W = q_W * (shaft.p1 - shaft.p0).normalized();
  const Vec3 to = portal.p_W - p_W - offset_W;
  const double way = to.dot(out.along_W);
  out.e_W = to - way * out.along_W;
  out.lever_W = offset_W + way * out.along_W;
  return out;
}

// Turns about the origin so that the axis beside the portal goes by `step`, for small turns.
Quat swung(const Quat& q, const Vec3& lever, const Vec3& step) {
  const double square = lever.squaredNorm();
  if (!(square > kShortestLever_m * kShortestLever_m)) return q;
  const Vec3 half = 0.5 * lever.cross(step) / square;
  return (Quat(1, half.x(), half.y(), half.z()) * q).normalized();
}

// The force with which the skin and the springs beside it answer an offset e.
struct Share {
  double force_n = 0;
  double shift = 0;  // of e, by which the origin gives way, m
};

Share share_of(double e, double lever, const PortalHand& hand, const PortalSkin& skin) {
  const double k = hand.stiffness_n_per_m;
  const double give = 1 / k + lever * lever / (k * kSwing_m * kSwing_m);
  double force = e / (1 / skin.stiffness_n_per_m + give);
  if (force > kMostYield_m * skin.stiffness_n_per_m) force = (e - kMostYield_m) / give;
  return {force, force / k};
}

// Coulomb friction on a spring: the depth at which it holds follows once it pulls too far.
double rubbed(double depth, double press_n, double scale, const PortalSkin& skin,
              PortalHold& hold) {
  const double ratio = hold.sliding ? skin.dynamic_friction : skin.static_friction;
  const double most = scale * ratio * press_n / skin.stiffness_n_per_m;
  const double kept = scale * skin.dynamic_friction * press_n / skin.stiffness_n_per_m;
  const double stretch = depth - hold.anchor_m;
  hold.sliding = std::abs(stretch) > most;
  if (hold.sliding) hold.anchor_m = depth - std::copysign(std::min(kept, most), stretch);
  return skin.stiffness_n_per_m * (hold.anchor_m - depth);
}

double tip_depth(const Portal& portal, const Capsule& shaft, const Pose& X_WP) {
  return portal.nhat_W.dot(X_WP * shaft.p0 - portal.p_W);
}

bool points_inwards(const Portal& portal, const Capsule& shaft, const Pose& X_WP) {
  constexpr double kSteepest = 0.2;
  const Vec3 along_W = X_WP.rotate((shaft.p1 - shaft.p0).normalized());
  return along_W.dot(portal.nhat_W) < -kSteepest;
}

std::uint32_t nearest_portal(std::span<const Portal> portals, const Capsule& shaft,
                             const Pose& X_WP) {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = PortalHold::kNone;
  for (std::uint32_t i = 0; i < portals.size(); ++i) {
    if (portals[i].made != kNotMade && !(portals[i].open && portals[i].bare)) continue;
    const double off = off_portal(portals[i], shaft, X_WP);
    if (!(off < least) || !points_inwards(portals[i], shaft, X_WP)) continue;
    least = off;
    nearest = i;
  }
  return nearest;
}

void enter(std::uint32_t portal, PortalHold& hold) {
  hold.portal = portal;
  hold.anchor_m = 0;
  hold.sliding = false;
  hold.grip = 0;
}

}  // namespace

double off_portal(const Portal& portal, const Capsule& shaft, const Pose& X_WT) {
  return beside(portal, shaft, X_WT.p, X_WT.q).e_W.norm();
}

Quat through_portal(const Portal& portal, const Capsule& shaft, const Vec3& p_W, const Quat& q_W) {
  // Newton's method on a turn: what is left of e falls with its square.
  constexpr int kSteps = 4;
  Quat q = q_W;
  for (int i = 0; i < kSteps; ++i) {
    const Beside at = beside(portal, shaft, p_W, q);
    const double off = at.e_W.norm();
    if (!(off > kMostYield_m)) break;
    q = swung(q, at.lever_W, (1 - kMostYield_m / off) * at.e_W);
  }
  return q;
}

void PortalRing::raise(const Quat& q_WT, std::span<FreeHalfSpace> out) const {
  constexpr double kHalfRoot = 0.70710678118654752;
  constexpr std::array<std::array<double, 2>, kPlanes> kWays{{{1, 0},
                                                              {kHalfRoot, kHalfRoot},
                                                              {0, 1},
                                                              {-kHalfRoot, kHalfRoot},
                                                              {-1, 0},
                                                              {-kHalfRoot, -kHalfRoot},
                                                              {0, -1},
                                                              {kHalfRoot, -kHalfRoot}}};
  const Vec3 along_T = (shaft.p1 - shaft.p0).normalized();
  const Vec3 other_T = std::abs(along_T.z()) > 0.5 ? Vec3::UnitX() : Vec3::UnitZ();
  const Vec3 u_T = other_T.cross(along_T).normalized();
  const Vec3 u_W = q_WT * u_T;
  const Vec3 v_W = q_WT * along_T.cross(u_T);
  const Vec3 middle_W = p_W - q_WT * shaft.p0;
  for (std::size_t i = 0; i < kPlanes; ++i) {
    const Vec3 n_W = kWays[i][0] * u_W + kWays[i][1] * v_W;
    out[i] = {n_W, n_W.dot(middle_W) - radius_m};
  }
}

// An octagon's corners reach out by no more than the inverse of this.
constexpr double kInCorner = 0.92;

PortalRing ring_of(const Portal& portal, const Capsule& shaft, const Pose& X_WT) {
  constexpr double kRoom_m = 5e-5;
  return {portal.p_W, shaft,
          std::max(kMostYield_m + kRoom_m, kInCorner * off_portal(portal, shaft, X_WT))};
}

PortalRing ring_about_line(const Vec3& p_W, const Vec3& along_W, const Pose& X_WT) {
  constexpr double kRoom_m = 2e-5;
  const Vec3 off_W = X_WT.p - p_W;
  const double off = (off_W - off_W.dot(along_W) * along_W).norm();
  return {p_W, {Vec3::Zero(), Vec3::UnitZ(), 0}, std::max(kRoom_m, kInCorner * off)};
}

void follow_portals(std::span<const Portal> portals, const Capsule& shaft, const Pose& X_WP,
                    const Pose& X_WD, bool start, std::uint32_t let_in, PortalHold& hold) {
  if (hold.portal != PortalHold::kNone) {
    const Portal& portal = portals[hold.portal];
    const double depth = tip_depth(portal, shaft, X_WP);
    const bool hand_is_out = tip_depth(portal, shaft, X_WD) < -kWithdrawn_m;
    if (depth < -kFarOut_m || (depth < -kWithdrawn_m && hand_is_out)) {
      hold = {};
      hold.grip = 1;
    }
    return;
  }
  hold.grip = std::max(0.0, hold.grip - kForgetPerTick);
  if (let_in < portals.size()) {
    hold.tip_depth_m = tip_depth(portals[let_in], shaft, X_WP);
    if (hold.tip_depth_m > 0) enter(let_in, hold);
    return;
  }
  const std::uint32_t nearest = nearest_portal(portals, shaft, X_WP);
  const std::uint32_t before = hold.nearest;
  const double depth_before = hold.tip_depth_m;
  hold.nearest = nearest;
  if (nearest == PortalHold::kNone) return;
  hold.tip_depth_m = tip_depth(portals[nearest], shaft, X_WP);
  const bool passes = before == nearest && depth_before <= 0;
  if (hold.tip_depth_m > 0 && (passes || start) &&
      off_portal(portals[nearest], shaft, X_WP) < kCapture_m)
    enter(nearest, hold);
}

PortalPivot pivot_in(std::span<const Portal> portals, const Capsule& shaft, const PortalHand& hand,
                     PortalHold& hold) {
  PortalPivot out{false, hand.X_WD.p, hand.X_WD.q, Vec3::Zero(), Vec3::UnitZ()};
  if (hold.portal == PortalHold::kNone) return out;
  const Portal& portal = portals[hold.portal];
  const Beside at = beside(portal, shaft, hand.X_WD.p, hand.X_WD.q);
  out.in = true;
  out.along_W = at.along_W;
  const double e = at.e_W.norm();
  const Share share = share_of(e, at.lever_W.norm(), hand, portal.skin);
  const Vec3 towards_W = e > 0 ? Vec3(at.e_W / e) : Vec3(Vec3::Zero());
  const double depth = -at.along_W.dot(hand.X_WD.p - portal.p_W);
  if (hold.grip == 0) hold.anchor_m = depth;  // it has just come in
  hold.grip = std::min(1.0, hold.grip + kGripPerTick);
  const double rub =
      rubbed(depth, portal.skin.squeeze_n + share.force_n, hand.friction_scale, portal.skin, hold);
  const Vec3 across_v_W = hand.v_W - hand.v_W.dot(at.along_W) * at.along_W;
  const Vec3 damped_W = share.force_n > 0
                            ? Vec3(-hand.damping_n_s_per_m * across_v_W.dot(towards_W) * towards_W)
                            : Vec3(Vec3::Zero());
  out.p_W = hand.X_WD.p + hold.grip * share.shift * towards_W;
  out.q_W = through_portal(portal, shaft, out.p_W, hand.X_WD.q);
  Vec3 sideways_W = share.force_n * towards_W + damped_W;
  // The damper may take the spring's part away, no more.
  if (sideways_W.dot(towards_W) < 0) sideways_W.setZero();
  out.force_W = hold.grip * (sideways_W - rub * at.along_W);
  return out;
}

}  // namespace osteon
