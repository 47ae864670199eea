#include "osteon/scene/tool.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "instrument/swept_tube.h"
#include "osteon/base/check.h"

namespace osteon {
namespace {

// 32 points on a sphere: the corners of an icosahedron and those of its dual dodecahedron.
std::vector<Vec3> ball_points(double radius_m) {
  const double phi = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> points;
  const auto add = [&](double x, double y, double z) {
    points.push_back(Vec3(x, y, z).normalized() * radius_m);
  };
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      add(0, s, t * phi);  // icosahedron
      add(s, t * phi, 0);
      add(s * phi, 0, t);
      add(0, s * phi, t / phi);  // dodecahedron
      add(s * phi, t / phi, 0);
      add(s / phi, 0, t * phi);
      for (const double u : {-1.0, 1.0}) add(s, t, u);
    }
  }
  return points;
}

Hull ball_hull(double radius_m) {
  HullOutcome outcome = build_hull(ball_points(radius_m));
  demand(outcome.hull.has_value(),
         "the probe's tip has no hull: its radius must be finite, above 0");
  return std::move(*outcome.hull);
}

// Sizes of a 1.5 mm arthroscopic hook probe as drawn, m. The hook leaves the tip along +x.
constexpr double kHookReach = 0.0010;  // straight part behind the ball
constexpr double kBendRadius = 0.0015;
constexpr double kShaftRadius = 0.00085;
constexpr double kShaftEnd = 0.100;
constexpr double kHandleRadius = 0.0045;
constexpr double kHandleEnd = 0.195;
constexpr double kHookTilt_rad = 0.35;  // of the hook above the plane across the shaft
constexpr int kSegments = 32;

Vec3 heading(double angle_rad) { return {std::cos(angle_rad), 0, std::sin(angle_rad)}; }

// The ball from its far pole up to where the neck leaves it.
void add_ball(std::vector<TubeRing>& rings, double radius_m, double neck_m) {
  constexpr int kRings = 12;
  const Vec3 out = heading(kHookTilt_rad);
  const double last = std::numbers::pi - std::asin(neck_m / radius_m);
  for (int i = 1; i <= kRings; ++i) {
    const double a = last * i / kRings;
    rings.push_back({-std::cos(a) * radius_m * out, out, std::sin(a) * radius_m});
  }
}

// The neck's straight part and its bend towards +z, growing to the shaft's radius.
Vec3 add_hook(std::vector<TubeRing>& rings, double neck_m) {
  constexpr int kRings = 10;
  const double tilt = kHookTilt_rad;
  const Vec3 start = kHookReach * heading(tilt);
  Vec3 p = start;
  for (int i = 0; i <= kRings; ++i) {
    const double share = static_cast<double>(i) / kRings;
    const double a = tilt + share * (std::numbers::pi / 2 - tilt);
    p = start + kBendRadius * Vec3(std::sin(a) - std::sin(tilt), 0, std::cos(tilt) - std::cos(a));
    rings.push_back({p, heading(a), neck_m + share * (0.8 * kShaftRadius - neck_m)});
  }
  return p;
}

// Straight shaft and handle as a turned profile: height above the tip and radius, m.
void add_shaft(std::vector<TubeRing>& rings, double x) {
  constexpr std::array<std::pair<double, double>, 12> kProfile{{
      {0.012, kShaftRadius},
      {0.040, kShaftRadius},
      {kShaftEnd - 0.004, kShaftRadius},
      {kShaftEnd - 0.001, 1.6 * kShaftRadius},
      {kShaftEnd + 0.003, 0.75 * kHandleRadius},
      {kShaftEnd + 0.008, kHandleRadius},
      {kShaftEnd + 0.030, kHandleRadius},
      {kShaftEnd + 0.045, 0.88 * kHandleRadius},
      {kShaftEnd + 0.060, kHandleRadius},
      {kHandleEnd - 0.004, kHandleRadius},
      {kHandleEnd - 0.0015, 0.85 * kHandleRadius},
      {kHandleEnd - 0.0003, 0.5 * kHandleRadius},
  }};
  for (const auto& [z, radius] : kProfile) rings.push_back({Vec3(x, 0, z), Vec3::UnitZ(), radius});
}

TriMesh probe_mesh(double tip_radius_m) {
  const double neck = 0.6 * tip_radius_m;
  std::vector<TubeRing> rings;
  add_ball(rings, tip_radius_m, neck);
  const Vec3 bend_end = add_hook(rings, neck);
  add_shaft(rings, bend_end.x());
  const Vec3 pole = -tip_radius_m * heading(kHookTilt_rad);
  return sweep_tube(pole, rings, Vec3(bend_end.x(), 0, kHandleEnd), kSegments);
}

}  // namespace

Tool make_wrist_probe(double tip_radius_m) {
  Tool tool;
  tool.name = "wrist_probe";
  tool.tip_radius_m = tip_radius_m;
  tool.pieces.push_back(ball_hull(tip_radius_m));
  tool.bodies.push_back(make_convex_body(tool.pieces.front()));
  tool.rods.push_back({Vec3::Zero(), Vec3::Zero(), tip_radius_m});
  tool.mesh = probe_mesh(tip_radius_m);
  return tool;
}

}  // namespace osteon
