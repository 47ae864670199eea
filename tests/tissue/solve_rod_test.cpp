#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "osteon/tissue/solve.h"

namespace osteon {
namespace {

constexpr double kPi = std::numbers::pi;

/// A straight rod along x from 0.
struct Wire {
  double length_m = 0.1, radius_m = 1e-3, young_pa = 1e6, poisson = 0.3;
  int segments = 40;

  double bending_n_m2() const { return young_pa * kPi * std::pow(radius_m, 4) / 4; }
};

Aabb about(const Vec3& p, double half_m) {
  Aabb box;
  box.include(p - Vec3::Constant(half_m));
  box.include(p + Vec3::Constant(half_m));
  return box;
}

SolveScene scene_of(const Wire& wire, double time_s, double damping_per_s) {
  SolveScene scene;
  scene.name = "wire";
  RodShape rod;
  rod.points_m = {Vec3::Zero(), {wire.length_m, 0, 0}};
  rod.radius_m = wire.radius_m;
  rod.segments = wire.segments;
  scene.body.rod = rod;
  scene.model = TissueModel::kRod;
  scene.material = {wire.young_pa, wire.poisson, 1000, damping_per_s};
  scene.time_s = time_s;
  return scene;
}

/// End of a clamped elastica of length 1 under a force p across it (force times length squared over
/// bending stiffness): the angle's equation t'' = -p cos t by shooting, fourth-order steps.
Vec3 elastica_end(double p) {
  const auto shoot = [p](double start) {
    constexpr int kSteps = 2000;
    constexpr double h = 1.0 / kSteps;
    double t = 0, k = start;
    Vec3 end = Vec3::Zero();
    for (int n = 0; n < kSteps; ++n) {
      const double k1 = k, m1 = -p * std::cos(t);
      const double k2 = k + 0.5 * h * m1, m2 = -p * std::cos(t + 0.5 * h * k1);
      const double k3 = k + 0.5 * h * m2, m3 = -p * std::cos(t + 0.5 * h * k2);
      const double k4 = k + h * m3, m4 = -p * std::cos(t + h * k3);
      const double middle = t + 0.5 * h * k2;
      end += h * Vec3(std::cos(middle), std::sin(middle), 0);
      t += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      k += h / 6 * (m1 + 2 * m2 + 2 * m3 + m4);
    }
    return Vec3(end.x(), end.y(), k);
  };
  double lo = 0, hi = 2 * p;
  for (int n = 0; n < 60; ++n) (shoot(0.5 * (lo + hi)).z() > 0 ? hi : lo) = 0.5 * (lo + hi);
  return shoot(0.5 * (lo + hi));
}

TEST(SolveRod, ClampedRodUnderALargeLoadIsTheElastica) {
  Wire wire;
  SolveScene scene = scene_of(wire, 2.5, 8);
  // The first segment lies in the clamp, before x = 0.
  const double l = wire.length_m / wire.segments;
  scene.body.rod->points_m[0] = {-l, 0, 0};
  scene.body.rod->segments = wire.segments + 1;
  Aabb clamp = about({-0.5 * l, 0, 0}, 0.51 * l);
  scene.fixed.push_back({clamp});
  for (const double p : {1.0, 3.0}) {
    const double force = p * wire.bending_n_m2() / (wire.length_m * wire.length_m);
    scene.loads = {{about({wire.length_m, 0, 0}, 1e-4), {0, 0, -force}, 0.3}};
    scene.probes_m = {{wire.length_m, 0, 0}};
    const auto result = solve(scene);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_TRUE(result->settled);
    const Vec3 end = elastica_end(p);
    const Vec3 moved = result->probes[0].moved_m / wire.length_m;
    EXPECT_NEAR(-moved.z() / end.y(), 1, 0.02) << p;
    EXPECT_NEAR(-moved.x() / (1 - end.x()), 1, 0.02) << p;
    EXPECT_NEAR(result->reactions[0].force_n.z() / force, 1, 1e-3);
    // The clamp's moment about the middle of what it holds: force times arm.
    const double arm = wire.length_m * (1 + moved.x()) + 0.5 * l;
    ASSERT_TRUE(result->reactions[0].moment_n_m);
    EXPECT_NEAR(-result->reactions[0].moment_n_m->y() / (force * arm), 1, 2e-3);
  }
}

TEST(SolveRod, HangingRodIsTheCatenary) {
  Wire wire;
  wire.radius_m = 1e-4;
  wire.segments = 60;
  SolveScene scene = scene_of(wire, 1.2, 15);
  scene.gravity_m_per_s2 = {0, 0, -9.81};
  constexpr double kSpan = 0.06;
  scene.fixed.push_back({about(Vec3::Zero(), 1e-5)});
  scene.moved.push_back(
      {about({wire.length_m, 0, 0}, 1e-5), {true, true, true}, {kSpan - wire.length_m, 0, 0}, 0.5});
  scene.probes_m = {{0.5 * wire.length_m, 0, 0}};
  const auto result = solve(scene);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(result->settled);
  double lo = 0.001, hi = 1;  // 2 a sinh(span / 2a) = length
  for (int n = 0; n < 100; ++n) {
    const double a = 0.5 * (lo + hi);
    (2 * a * std::sinh(0.5 * kSpan / a) > wire.length_m ? lo : hi) = a;
  }
  const double sag = lo * (std::cosh(0.5 * kSpan / lo) - 1);
  EXPECT_NEAR(-result->probes[0].moved_m.z() / sag, 1, 0.01);
  const double weight = 1000 * kPi * wire.radius_m * wire.radius_m * 9.81;
  EXPECT_NEAR(-result->reactions[0].force_n.x() / (weight * lo), 1, 0.03);
  EXPECT_NEAR(result->reactions[0].force_n.z() / (0.5 * weight * wire.length_m), 1, 1e-3);
}

// Half a turn about a cylinder, one end drawn, the other loaded: T2 / T1 = exp(mu pi) (Euler 1769).
TEST(SolveRod, DrawnOverACylinderIsTheCapstans) {
  constexpr double kRadius = 0.01, kMu = 0.3, kHang = 0.02, kLoad = 0.05;
  Wire wire;
  wire.radius_m = 5e-4;
  wire.young_pa = 1e7;
  SolveScene scene = scene_of(wire, 0.25, 20);
  RodShape& rod = *scene.body.rod;
  rod.straight_at_rest = true;
  rod.segments = 60;
  const double r = kRadius + wire.radius_m;
  rod.points_m = {{-r, 0, -kHang}};
  for (int n = 0; n <= 24; ++n)
    rod.points_m.push_back({-r * std::cos(kPi * n / 24), 0, r * std::sin(kPi * n / 24)});
  rod.points_m.push_back({r, 0, -kHang});
  scene.loads.push_back({about({-r, 0, -kHang}, 1e-4), {0, 0, -kLoad}, 0.05});
  scene.moved.push_back({about({r, 0, -kHang}, 1e-4), {true, true, true}, {0, 0, -0.004}, 0.4});
  scene.obstacles.push_back({{0, -0.02, 0}, {0, 0.02, 0}, kRadius, kMu});
  const auto result = solve(scene);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_FALSE(result->lost);
  EXPECT_NEAR(-result->reactions[0].force_n.z() / (kLoad * std::exp(kMu * kPi)), 1, 0.05);
}

// Hinged ends: straight below pi^2 E I / L^2, bent above. A weight of a millionth helps it to
// choose.
TEST(SolveRod, BucklesAtEulersLoad) {
  Wire wire;
  wire.segments = 24;
  const double critical = kPi * kPi * wire.bending_n_m2() / (wire.length_m * wire.length_m);
  double sideways[2];
  for (int n = 0; n < 2; ++n) {
    SolveScene scene = scene_of(wire, 8, 2);
    scene.gravity_m_per_s2 = {0, 0, -2e-4};
    scene.fixed.push_back({about(Vec3::Zero(), 1e-4)});
    scene.fixed.push_back({about({wire.length_m, 0, 0}, 1e-4), {false, true, true}});
    scene.loads.push_back(
        {about({wire.length_m, 0, 0}, 1e-4), {-critical * (n == 0 ? 0.95 : 1.05), 0, 0}, 0.5});
    scene.probes_m = {{0.5 * wire.length_m, 0, 0}};
    const auto result = solve(scene);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_FALSE(result->lost);
    sideways[n] = result->probes[0].moved_m.tail<2>().norm();
  }
  EXPECT_LT(sideways[0], 0.002 * wire.length_m);
  EXPECT_GT(sideways[1], 0.1 * wire.length_m);
}

// A closed ring of a straight rod, twisted between its ends: flat below a twist of
// 2 pi sqrt(3) EI / GJ (Michell 1889; Goriely 2006), thrown out of its plane above.
TEST(SolveRod, TwistedRingLeavesItsPlaneAtMichellsTwist) {
  constexpr double kRadius = 0.05;
  constexpr int kSegments = 120;
  const auto at = [](int i) {
    const double a = 2 * kPi * (i % kSegments) / kSegments;
    return Vec3(kRadius * std::sin(a), -kRadius * std::cos(a), 0);
  };
  const double critical = 2 * kPi * std::sqrt(3.0) * 1.3;  // EI / GJ = 1 + nu
  double thrown[2];
  for (int n = 0; n < 2; ++n) {
    Wire wire;
    wire.radius_m = 5e-4;
    wire.young_pa = 1e9;
    SolveScene scene = scene_of(wire, 0.75, 15);
    RodShape& rod = *scene.body.rod;
    rod.straight_at_rest = true;
    rod.segments = kSegments;
    rod.points_m.clear();
    for (int i = 0; i <= kSegments; ++i) rod.points_m.push_back(at(i));
    scene.gravity_m_per_s2 = {0, 0, 0.002};
    Aabb first = about(at(0), 1e-5), last = about(at(0), 1e-5);
    first.include(at(1));
    last.include(at(kSegments - 1));
    first = first.grown(1e-5), last = last.grown(1e-5);
    MovedBox turn;
    turn.box_m = last;
    turn.over_s = 0.6;
    const Vec3 along = (at(0) - at(kSegments - 1)).normalized();
    turn.turn_rad = (n == 0 ? 0.95 : 1.05) * critical * along;
    scene.fixed.push_back({first});
    scene.moved.push_back(turn);
    scene.probes_m = {at(kSegments / 2), at(kSegments / 4)};
    const auto result = solve(scene);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_FALSE(result->lost);
    thrown[n] = result->probes[0].moved_m.norm() / kRadius;
  }
  EXPECT_LT(thrown[0], 0.2);
  EXPECT_GT(thrown[1], 0.8);
}

// An overhand knot (Shastri's trefoil) in a straight rod, its ends drawn to nine tenths of its
// length. Without the knot the rod would be slack there; with it, it is taut, and nothing has
// passed through itself.
TEST(SolveRod, OverhandKnotHolds) {
  Wire wire;
  SolveScene scene = scene_of(wire, 0.6, 20);
  RodShape& rod = *scene.body.rod;
  rod.straight_at_rest = true;
  rod.segments = 72;
  rod.points_m.clear();
  double length = 0;
  for (int n = 0; n <= 80; ++n) {
    const double u = 2.15 * (-1 + 2.0 * n / 80);
    rod.points_m.push_back(0.004 * Vec3(u * u * u - 3 * u, u * u * u * u - 4 * u * u,
                                        0.8 * (std::pow(u, 5) / 5 - 2 * u)));
    if (n > 0) length += (rod.points_m[n] - rod.points_m[n - 1]).norm();
  }
  const Vec3 from = rod.points_m.front(), to = rod.points_m.back(), chord = to - from;
  const Vec3 by = 0.5 * (0.9 * length / chord.norm() - 1) * chord;
  scene.moved.push_back({about(from, 1e-5), {true, true, true}, -by, 0.45});
  scene.moved.push_back({about(to, 1e-5), {true, true, true}, by, 0.45});
  const auto result = solve(scene);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_FALSE(result->lost);
  const double pull = result->reactions[1].force_n.dot(chord.normalized());
  EXPECT_GT(pull, 0.03 * wire.young_pa * kPi * wire.radius_m * wire.radius_m);
  EXPECT_NEAR(-result->reactions[0].force_n.dot(chord.normalized()) / pull, 1, 0.02);
}

TEST(SolveRod, NamesTheKeyOfWhatIsNotSound) {
  const auto complaint = [](auto change) {
    SolveScene scene = scene_of(Wire{}, 0.01, 1);
    change(scene);
    const auto result = solve(scene);
    return result ? std::string("none") : result.error().message();
  };
  const auto names = [](const std::string& text, const char* key) {
    EXPECT_NE(text.find(key), std::string::npos) << text;
  };
  names(complaint([](SolveScene& s) { s.body.rod->points_m.pop_back(); }), "mesh.rod.points_mm");
  names(complaint([](SolveScene& s) { s.body.rod->points_m[1] = Vec3::Zero(); }),
        "mesh.rod.points_mm[1]");
  names(complaint([](SolveScene& s) { s.body.rod->segments = 100000; }), "mesh.rod.segments");
  names(complaint([](SolveScene& s) { s.body.rod->segments = 9000; }), "mesh.rod.segments");
  names(complaint([](SolveScene& s) { s.body.rod->radius_m = 0; }), "mesh.rod.radius_mm");
  names(complaint([](SolveScene& s) { s.model = TissueModel::kLinear; }), "material.model");
  names(complaint([](SolveScene& s) { s.probes_m = {{0, 0.002, 0}}; }), "run.probe_mm[0]");
  names(complaint([](SolveScene& s) {
          s.body.rod->points_m = {{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.03, 0}, {0.02, -0.03, 0}};
        }),
        "passes through itself");
}

TEST(SolveRod, TheSameSceneGivesTheSameBitsAndAClosedSkin) {
  SolveScene scene = scene_of(Wire{}, 0.1, 1);
  scene.gravity_m_per_s2 = {0, 0.3, -9.81};
  scene.fixed.push_back({about(Vec3::Zero(), 1e-4), {true, true, true}, true});
  const auto first = solve(scene), again = solve(scene);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(solve_vtk(first->shape), solve_vtk(again->shape));
  // Each edge of the skin is walked once each way; its volume is the rod's.
  const SolveShape& skin = first->shape;
  ASSERT_EQ(skin.corners_a_cell, 3u);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  double volume = 0;
  for (std::size_t i = 0; i < skin.corners.size(); i += 3) {
    const std::uint32_t* t = skin.corners.data() + i;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second);
    volume += skin.points_m[t[0]].dot(skin.points_m[t[1]].cross(skin.points_m[t[2]])) / 6;
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a}));
  EXPECT_NEAR(volume / (kPi * 1e-6 * 0.1), 1, 0.06);  // of twelve sides
}

}  // namespace
}  // namespace osteon
