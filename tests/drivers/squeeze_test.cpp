// Two devices squeeze a bone on its springs from both sides: two arms of a PHANToM, two joysticks,
// one of each.
#include <gtest/gtest.h>

#include <functional>

#include "device/joystick/joystick_rig.h"
#include "device/phantom/stub_library.h"
#include "drivers/two_loops.h"
#include "emulated/virtual_usb.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {
namespace {

using testing::StubLibrary;
using testing::TwoLoops;

constexpr double kHalf_m = 0.010;
constexpr double kPressed_m = 0.0015;  // behind the face, with a tip of 0.75 mm

std::shared_ptr<const Case> one_block() {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = test::box(Vec3::Constant(kHalf_m));
  def.bones.push_back(bone);
  auto made = build_case(std::move(def));
  return made ? std::make_shared<const Case>(std::move(*made)) : nullptr;
}

/// A device in a hand.
struct Squeezer {
  std::unique_ptr<HapticDevice> device;
  std::function<void(const testing::WantedInV&)> lead;
  std::function<Vec3()> motors_V;
};

Squeezer arm(StubLibrary& stub, const std::shared_ptr<HdSession>& session, bool left) {
  StubArm& the_arm = left ? *stub.left : *stub.right;
  const auto lead = [&the_arm](const testing::WantedInV& wanted) {
    testing::want(the_arm, 1000 * wanted.X_VD.p + Vec3(0, 50, -30), 1000 * wanted.v_V);
  };
  return {PhantomDevice::open(session, left ? "Left Device" : "Right Device").value(), lead,
          [&the_arm] { return testing::motor_force(the_arm); }};
}

Squeezer joystick(JoystickDialectKind dialect) {
  auto opened = VirtualUsbJoystick::open(testing::shipped_profile(dialect), {}, UsbSpeed::kHigh);
  EXPECT_TRUE(opened) << opened.error().message();
  VirtualUsbJoystick* const held = opened->get();
  const auto lead = [held](const testing::WantedInV& wanted) {
    held->set_target(wanted.X_VD, wanted.v_V, 0);
  };
  return {std::move(*opened), lead, [held] { return held->mechanics().motors(); }};
}

// A hand that comes from a side along x, until it wants the tip 1.5 mm behind the block's face.
ProbePath from_side(double sign) {
  ProbePath path;
  for (const auto& [time_s, x_mm] : {std::pair{0.0, 14.0}, {0.7, 14.0}, {1.4, 9.25}, {9.0, 9.25}})
    path.samples.push_back({time_s, {Vec3(1e-3 * sign * x_mm, 0, 0)}, false});
  return path;
}

// What the two squeeze with once all is at rest. Whatever they differ by, the bone's spring holds:
// its force is stiffness times way.
void expect_balance(StubLibrary& stub, std::array<Squeezer, 2> hands) {
  SessionSettings settings = testing::RunLoop::settings();
  settings.physics.hold_bones = false;
  TwoLoops loops(one_block(), settings, *hands[0].device, *hands[1].device);
  const std::array<ProbePath, 2> paths = {from_side(-1), from_side(1)};
  for (double t = 0; t < 3; t += 0.001) {
    for (std::size_t h = 0; h < 2; ++h) hands[h].lead(testing::wanted_in_V(paths[h], t));
    stub.step(1);
    loops.tick();
  }
  const Quat q_WV = testing::turned_mapping().X_WV.q;
  const Vec3 left_W = q_WV * hands[0].motors_V();
  const Vec3 right_W = q_WV * hands[1].motors_V();
  const double way_m = loops.session.bones().bones[0].X_WB.p.x();
  std::printf("left %.3f N, right %.3f N, the bone has gone %.4f mm\n", left_W.x(), right_W.x(),
              1e3 * way_m);
  // Each hand's grip and the coupling are two springs in a row; the tip's corners lie a little
  // within its ball.
  const double wanted_n = kPressed_m / (1 / HandParams{}.grip_stiffness_n_per_m +
                                        1 / settings.haptic.stiffness_n_per_m);
  EXPECT_NEAR(left_W.x(), -wanted_n, 0.05 * wanted_n);
  EXPECT_NEAR(right_W.x(), wanted_n, 0.05 * wanted_n);
  // The hands' forces are those of the bone on them: their sum is what its spring bears.
  EXPECT_NEAR(left_W.x() + right_W.x(), -settings.physics.spring_n_per_m * way_m, 0.1);
  EXPECT_LT(std::abs(way_m), 1e-3);
  for (std::size_t h = 0; h < 2; ++h) {
    EXPECT_EQ(loops.cause(h), ForceOff::kNone) << describe(loops.cause(h));
    EXPECT_EQ(loops.session.tool_state(h).contact_count > 0, true);
  }
}

// Each takes the arms where a hand waits beside the block.
void bring_to_start(StubLibrary& stub, std::array<Squeezer, 2>& hands) {
  for (int i = 0; i < 500; ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      hands[h].lead(testing::wanted_in_V(from_side(h == 0 ? -1 : 1), 0));
      (void)hands[h].device->read();
    }
    stub.step(1);
  }
}

TEST(Squeeze, ByTwoPhantomArms) {
  StubLibrary stub;
  const auto session = stub.session();
  std::array<Squeezer, 2> hands = {arm(stub, session, true), arm(stub, session, false)};
  bring_to_start(stub, hands);
  expect_balance(stub, std::move(hands));
}

TEST(Squeeze, ByTwoJoysticks) {
  StubLibrary stub;
  std::array<Squeezer, 2> hands = {joystick(JoystickDialectKind::kVector),
                                   joystick(JoystickDialectKind::kPid)};
  bring_to_start(stub, hands);
  expect_balance(stub, std::move(hands));
}

TEST(Squeeze, ByAPhantomArmAndAJoystick) {
  StubLibrary stub;
  const auto session = stub.session();
  std::array<Squeezer, 2> hands = {arm(stub, session, true),
                                   joystick(JoystickDialectKind::kVector)};
  bring_to_start(stub, hands);
  expect_balance(stub, std::move(hands));
}

}  // namespace
}  // namespace osteon
