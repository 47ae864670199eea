// The closed loop of the emulated hand and the haptic tick: pressing with 5 N it must come to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesh/shapes.h"
#include "osteon/device/virtual_hand.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::Rig;

constexpr double kDt = 0.001;

struct Loop {
  double mass_kg;
  double grip_n_s_per_m;
  double stiffness_n_per_m;
  int delay_ticks;  // of the force on its way to the hand
};

// A ball of 10 mm with about 200 corners: a bone that is flat nowhere.
Bone round_bone(const Material& material) {
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) {  // Fibonacci's lattice on the sphere
    const double z = 1 - (2 * i + 1) / 200.0;
    const double a = 2.399963229728653 * i;
    const double r = std::sqrt(1 - z * z);
    points.push_back(0.010 * Vec3(r * std::cos(a), r * std::sin(a), z));
  }
  Pose X_WB;
  X_WB.p.z() = -0.010;
  return test::bone_of({test::hull_of(points)}, X_WB, material);
}

Bone flat_bone(const Material& material) {
  return test::bone_of({test::box_hull(Vec3(0.02, 0.02, 0.005), Vec3(0, 0, -0.005))}, {}, material);
}

struct Outcome {
  std::vector<double> window_energy;  // largest of each quarter second, J
  double last_swing_m = 0;            // of the hand in the last quarter second
  double last_force_n = 0;
};

// The hand comes down at 50 mm/s onto the top and aims where coupling and grip balance at 5 N.
Outcome press(Bone bone, const Loop& loop, double seconds) {
  Rig rig({std::move(bone)});
  rig.params = HapticParams{};
  rig.params.stiffness_n_per_m = loop.stiffness_n_per_m;
  constexpr double kGrip = 500;
  VirtualHand hand({loop.mass_kg, kGrip, loop.grip_n_s_per_m});
  const double reach = rig.the_case->bones[0].field
                           ? rig.tool->tip_radius_m
                           : support(rig.tool->bodies.front(), -Vec3::UnitZ());
  const double goal = reach - 5 / loop.stiffness_n_per_m - 5 / kGrip;
  Pose wanted;
  wanted.p.z() = 0.005;
  hand.reset(wanted);

  std::vector<Vec3> sent{Vec3::Zero()};
  std::vector<Vec3> place;
  std::vector<Vec3> speed;
  const int ticks = static_cast<int>(seconds / kDt);
  for (int i = 0; i < ticks; ++i) {
    const double z = std::max(goal, 0.005 - 0.05 * i * kDt);
    wanted.p.z() = z;
    const Vec3 wanted_v(0, 0, z > goal ? -0.05 : 0);
    ToolInput input;
    input.X_WD = hand.pose();
    input.v_W = hand.velocity();
    sent.push_back(rig.loop.tick(input, rig.bones, 0, rig.params).force_W);
    hand.step(kDt, wanted, wanted_v, sent[sent.size() - 1 - loop.delay_ticks]);
    place.push_back(hand.pose().p);
    speed.push_back(hand.velocity());
  }

  // Energy of the swing about the place where it ends.
  Outcome out;
  const Vec3 rest = place.back();
  const double spring = loop.stiffness_n_per_m + kGrip;
  for (int from = 1000; from + 250 <= ticks; from += 250) {
    double largest = 0;
    out.last_swing_m = 0;
    for (int i = from; i < from + 250; ++i) {
      largest = std::max(largest, 0.5 * loop.mass_kg * speed[i].squaredNorm() +
                                      0.5 * spring * (place[i] - rest).squaredNorm());
      out.last_swing_m = std::max(out.last_swing_m, (place[i] - rest).norm());
    }
    out.window_energy.push_back(largest);
  }
  out.last_force_n = sent.back().norm();
  return out;
}

std::vector<Loop> loops() {
  std::vector<Loop> out;
  for (const double mass : {0.05, 0.15, 0.5})
    for (const double grip : {2.0, 12.0})
      for (const double k : {500.0, 2000.0, 3000.0})
        for (const int delay : {0, 1}) out.push_back({mass, grip, k, delay});
  return out;
}

std::string name(const Loop& l) {
  return "mass " + std::to_string(l.mass_kg) + " grip " + std::to_string(l.grip_n_s_per_m) + " k " +
         std::to_string(l.stiffness_n_per_m) + " delay " + std::to_string(l.delay_ticks);
}

void expect_settled(const Outcome& o, const Loop& loop) {
  constexpr double kNothing = 1e-13;  // J: 0.5 nm of a 1000 N/m spring
  for (std::size_t i = 1; i < o.window_energy.size(); ++i)
    EXPECT_LE(o.window_energy[i], 0.85 * o.window_energy[i - 1] + kNothing)
        << name(loop) << " window " << i;
  EXPECT_LT(o.last_swing_m, 3e-5) << name(loop);
  EXPECT_NEAR(o.last_force_n, 5, 0.2) << name(loop);
}

TEST(ClosedLoop, FiveNewtonsOnAFlatBoneSettle) {
  for (const Loop& loop : loops()) expect_settled(press(flat_bone({1e5, 0, 0}), loop, 5), loop);
}

TEST(ClosedLoop, FiveNewtonsWithFrictionOnARoundBoneSettle) {
  for (const Loop& loop : loops())
    expect_settled(press(round_bone({1e5, 0.3, 0.2}), loop, 5), loop);
}

TEST(ClosedLoop, FiveNewtonsOnADistanceFieldSettle) {
  const Bone flat = test::field_bone(test::cube(0.004, Vec3(0, 0, -0.004)), {}, {1e5, 0, 0});
  const Bone round =
      test::field_bone(test::sphere(0.004, 30, Vec3(0, 0, -0.004)), {}, {1e5, 0.3, 0.2});
  for (const Loop& loop : loops()) {
    expect_settled(press(flat, loop, 5), loop);
    expect_settled(press(round, loop, 5), loop);
  }
}

// The bound that the header states is real: beyond it the late force does make the loop swing.
TEST(ClosedLoop, ALateForceBeyondTheStatedBoundSwings) {
  const Outcome o = press(flat_bone({1e5, 0, 0}), {0.15, 2, 6000, 1}, 5);
  EXPECT_GT(o.last_swing_m, 1e-4);
}

}  // namespace
}  // namespace osteon
