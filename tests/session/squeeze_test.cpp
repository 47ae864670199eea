// Two emulated hands, light and heavy, loose and firm, press a bone on its springs from both sides
// and each other's instruments, and let go: the closed loop of hands, haptics and physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "osteon/collide/primitive.h"
#include "osteon/device/virtual_hand.h"
#include "session_fixtures.h"
#include "two_hands.h"

namespace osteon {
namespace {

constexpr double kTick_s = 0.001;
constexpr double kRod_m = 0.001;
constexpr double kBox_m = 0.0015;  // half of the thickness of the plates that meet
constexpr double kPressed_m = 0.0015;
constexpr double kPressed_s = 3, kEnd_s = 5;

std::shared_ptr<const Case> one_box(double below_m) {
  CaseDef def;
  def.name = "one box";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = testing::box_mesh(testing::kBoxHalf);
  bone.X_WB.p.z() = -below_m;
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  return std::make_shared<const Case>(std::move(*built));
}

Tray of_parts(const Primitive& left, const Primitive& right) {
  Tray tray;
  for (const Primitive& part : {left, right}) {
    Tool tool;
    tool.name = "part";
    tool.parts = {part};
    tray.push_back(std::make_shared<const Tool>(std::move(tool)));
  }
  return tray;
}

/// What the hands meet.
struct Thing {
  const char* name;
  std::shared_ptr<const Case> the_case;
  Tray tray;
  double touch_m;  ///< from the middle, where a hand touches
};

std::vector<Thing> things() {
  const double far = 0.05;
  const auto rod = [](const Vec3& along) { return make_rod(-along, along, kRod_m); };
  const auto plate = [](const Vec3& half) { return make_box({}, half); };
  return {{"bone", one_box(0), {}, testing::kBoxHalf.x() + 0.00075},
          {"crossed rods", one_box(far), of_parts(rod({0, 0, 0.02}), rod({0, 0.02, 0})), kRod_m},
          {"plates", one_box(far),
           of_parts(plate({kBox_m, 0.006, 0.010}), plate({kBox_m, 0.010, 0.006})), kBox_m},
          {"rod and plate", one_box(far),
           of_parts(rod({0, 0, 0.02}), plate({kBox_m, 0.010, 0.006})), 0.5 * (kRod_m + kBox_m)}};
}

SessionSettings settings_for(const Thing& thing) {
  SessionSettings settings = testing::two_hands();
  if (thing.tray.empty()) return settings;
  settings.tray = {"left's", "right's"};
  settings.hands[1].instrument = 1;
  return settings;
}

// Where a hand wants to be on its own side: it comes, presses 1.5 mm past the touch, and leaves.
double wanted(double t, double touch_m) {
  const double in = std::clamp((t - 0.2) / 0.6, 0.0, 1.0);
  const double out = std::clamp((t - kPressed_s) / 0.6, 0.0, 1.0);
  return touch_m + 0.003 - (0.003 + kPressed_m) * (in - out);
}

/// One run of two hands.
struct SqueezeLoop {
  SqueezeLoop(const Thing& the_thing, const std::array<HandParams, 2>& of_hands)
      : thing(the_thing),
        session(thing.the_case, settings_for(thing), thing.tray),
        hands{VirtualHand(of_hands[0]), VirtualHand(of_hands[1])} {
    for (std::size_t h = 0; h < 2; ++h) hands[h].reset(pose(h, 0));
  }
  static double side(std::size_t h) { return h == 0 ? -1 : 1; }
  Pose pose(std::size_t h, double t) const {
    return {Vec3(side(h) * wanted(t, thing.touch_m), 0, 0), Quat::Identity()};
  }
  const Vec3& force(std::size_t h) const { return session.tool_state(h).force_W; }

  void tick(double t) {
    std::array<HandInput, 2> inputs;
    for (std::size_t h = 0; h < 2; ++h) {
      inputs[h].input.X_WD = hands[h].pose();
      inputs[h].input.v_W = hands[h].velocity();
    }
    (void)session.tick(inputs);
    for (std::size_t h = 0; h < 2; ++h) {
      const Vec3 from = hands[h].pose().p;
      const Vec3 speed = (pose(h, t + kTick_s).p - pose(h, t).p) / kTick_s;
      hands[h].step(kTick_s, pose(h, t), speed, force(h));
      const Vec3 way = hands[h].pose().p - from;
      put_in_j -= force(h).dot(way);
      late_j += 2 * std::max((force(h) - last[h]).norm(), (force(h) - last_but_one[h]).norm()) *
                way.norm();
      last_but_one[h] = last[h];
      last[h] = force(h);
    }
    most_j = std::max(most_j, put_in_j);
  }

  const Thing& thing;
  Session session;
  std::array<VirtualHand, 2> hands;
  // What the hands have put in and not got back, and what a force that is a tick or two late lets
  // out beyond that.
  double put_in_j = 0, late_j = 0, most_j = 0;
  std::array<Vec3, 2> last{Vec3::Zero(), Vec3::Zero()}, last_but_one = last;
};

std::vector<std::array<HandParams, 2>> pairs_of_hands() {
  const HandParams usual, light{0.05, 500, 5}, heavy{0.5, 1500, 12}, loose{0.15, 50, 2};
  return {{usual, usual}, {light, light}, {heavy, heavy}, {light, heavy}, {usual, loose}};
}

std::string name(const HandParams& hand) {
  return std::to_string(hand.mass_kg) + " kg " + std::to_string(hand.grip_stiffness_n_per_m);
}

TEST(SqueezeLoop, GivesOutNoEnergyAndComesToRestWithOppositeForces) {
  for (const Thing& thing : things())
    for (const auto& pair : pairs_of_hands()) {
      SCOPED_TRACE(std::string(thing.name) + ", " + name(pair[0]) + ", " + name(pair[1]));
      SqueezeLoop loop(thing, pair);
      std::array<Vec3, 2> rest{Vec3::Zero(), Vec3::Zero()};
      double swing_m = 0, rest_n = 0;
      for (double t = 0; t < kEnd_s; t += kTick_s) {
        loop.tick(t);
        ASSERT_GT(loop.put_in_j, -loop.late_j - 1e-9) << t;
        if (t < kPressed_s - 0.25 || t >= kPressed_s) continue;
        for (std::size_t h = 0; h < 2; ++h) {
          if (rest[h].isZero(0)) rest[h] = loop.hands[h].pose().p;
          swing_m = std::max(swing_m, (loop.hands[h].pose().p - rest[h]).norm());
        }
        const double sum_n = (loop.force(0) + loop.force(1)).x();
        const SessionSettings settings = settings_for(thing);
        const double spring_n =
            settings.physics.spring_n_per_m * loop.session.bones().bones[0].X_WB.p.x();
        ASSERT_NEAR(sum_n, -spring_n, 0.02) << t;
        ASSERT_GT(loop.force(1).x(), 0.05) << t;
        rest_n = loop.force(1).x();
      }
      // Two alike share the way past the touch: grip and coupling are two springs in a row.
      const double grip = pair[0].grip_stiffness_n_per_m;
      if (grip == pair[1].grip_stiffness_n_per_m) {
        const double coupling = settings_for(thing).haptic.stiffness_n_per_m;
        const double wanted_n = kPressed_m / (1 / grip + 1 / coupling);
        EXPECT_NEAR(rest_n, wanted_n, 0.05 * wanted_n);
      }
      EXPECT_LT(swing_m, 3e-5);
      EXPECT_GT(loop.most_j, 5e-6);
      EXPECT_GT(loop.put_in_j, -0.05 * loop.most_j);
      EXPECT_TRUE(loop.force(0).isZero(0));
      EXPECT_TRUE(loop.force(1).isZero(0));
    }
}

}  // namespace
}  // namespace osteon
