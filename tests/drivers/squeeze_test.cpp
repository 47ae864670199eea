// Two devices squeeze a bone on its springs from both sides, and each other's instruments: two arms
// of a PHANToM, two joysticks, one of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "device/joystick/joystick_rig.h"
#include "device/phantom/stub_library.h"
#include "drivers/two_loops.h"
#include "emulated/virtual_usb.h"
#include "osteon/collide/primitive.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {
namespace {

using testing::StubLibrary;
using testing::TwoLoops;

constexpr double kHalf_m = 0.010;
constexpr double kPressed_m = 0.0015;  // behind the face, with a tip of 0.75 mm
constexpr double kRod_m = 0.001;       // radius of the instruments that meet

// `below_m`: so much lower than the hands, out of their way.
std::shared_ptr<const Case> one_block(double below_m = 0) {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = test::box(Vec3::Constant(kHalf_m));
  bone.X_WB.p.z() = -below_m;
  def.bones.push_back(bone);
  auto made = build_case(std::move(def));
  return made ? std::make_shared<const Case>(std::move(*made)) : nullptr;
}

// Rods that cross where the hands meet.
Tray crossed_rods() {
  Tray tray;
  for (const Vec3& along : {Vec3(0, 0, 0.02), Vec3(0, 0.02, 0)}) {
    Tool rod;
    rod.name = "rod";
    rod.parts = {make_rod(-along, along, kRod_m)};
    tray.push_back(std::make_shared<const Tool>(std::move(rod)));
  }
  return tray;
}

/// A device in a hand.
struct Squeezer {
  std::unique_ptr<HapticDevice> device;
  std::function<void(const testing::WantedInV&)> lead;
  std::function<Vec3()> motors_V;
  std::function<Vec3()> place_V;  ///< where the stylus truly is, but for a shift
  std::function<void()> unplug;
};

Squeezer arm(StubLibrary& stub, const std::shared_ptr<HdSession>& session, bool left) {
  StubArm& the_arm = left ? *stub.left : *stub.right;
  const auto lead = [&the_arm](const testing::WantedInV& wanted) {
    testing::want(the_arm, 1000 * wanted.X_VD.p + Vec3(0, 50, -30), 1000 * wanted.v_V);
  };
  return {
      PhantomDevice::open(session, left ? "Left Device" : "Right Device").value(), lead,
      [&the_arm] { return testing::motor_force(the_arm); },
      [&the_arm] { return Vec3(1e-3 * Vec3(the_arm.p_mm[0], the_arm.p_mm[1], the_arm.p_mm[2])); },
      [&the_arm] { the_arm.plugged = false; }};
}

Squeezer joystick(JoystickDialectKind dialect) {
  auto opened = VirtualUsbJoystick::open(testing::shipped_profile(dialect), {}, UsbSpeed::kHigh);
  EXPECT_TRUE(opened) << opened.error().message();
  VirtualUsbJoystick* const held = opened->get();
  const auto lead = [held](const testing::WantedInV& wanted) {
    held->set_target(wanted.X_VD, wanted.v_V, 0);
  };
  return {std::move(*opened), lead, [held] { return held->mechanics().motors(); },
          [held] { return held->mechanics().hand().pose().p; },
          [held] { held->bus().detach(held->port()); }};
}

// A hand that comes from a side along x until it wants to be at `to_mm`, and leaves after 3 s.
ProbePath from_side(double sign, double to_mm) {
  ProbePath path;
  for (const auto& [time_s, x_mm] :
       {std::pair{0.0, 14.0}, {0.7, 14.0}, {1.4, to_mm}, {3.0, to_mm}, {3.7, 14.0}, {9.0, 14.0}})
    path.samples.push_back({time_s, {Vec3(1e-3 * sign * x_mm, 0, 0)}, false});
  return path;
}

/// What is squeezed, how, and what comes of it.
struct Squeeze {
  std::shared_ptr<const Case> the_case;
  Tray tray;
  double to_mm;     ///< where each hand wants to be, on its own side of the middle
  double wanted_n;  ///< once all is at rest
};

// Each hand's grip and the coupling are two springs in a row.
double force_of(double stretch_m) {
  return stretch_m / (1 / HandParams{}.grip_stiffness_n_per_m +
                      1 / testing::RunLoop::settings().haptic.stiffness_n_per_m);
}

// The tip's corners lie a little within its ball.
Squeeze of_a_bone() { return {one_block(), {}, 9.25, force_of(kPressed_m)}; }

// Each is stretched by half of what both want to go past each other.
Squeeze of_each_other() {
  constexpr double kPast_mm = 1.5;
  return {one_block(0.05), crossed_rods(), -kPast_mm, force_of(1e-3 * kPast_mm + kRod_m)};
}

/// One run of both devices, tick by tick.
struct SqueezeRun {
  SqueezeRun(StubLibrary& the_stub, std::array<Squeezer, 2>& the_hands, const Squeeze& squeeze)
      : stub(the_stub),
        hands(the_hands),
        paths{from_side(-1, squeeze.to_mm), from_side(1, squeeze.to_mm)},
        loops(squeeze.the_case, settings(), *hands[0].device, *hands[1].device, squeeze.tray) {}

  static SessionSettings settings() {
    SessionSettings of_run = testing::RunLoop::settings();
    of_run.physics.hold_bones = false;
    return of_run;
  }
  // `each` is called after each tick.
  void run_to(
      double end_s, const std::function<void()>& each = [] {}) {
    for (; time_s < end_s; time_s += 0.001) {
      std::array<Vec3, 2> acting_V, from_V;
      for (std::size_t h = 0; h < 2; ++h) {
        acting_V[h] = hands[h].motors_V();
        from_V[h] = hands[h].place_V();
        hands[h].lead(testing::wanted_in_V(paths[h], time_s));
      }
      stub.step(1);
      loops.tick();
      for (std::size_t h = 0; h < 2; ++h)
        count_energy(h, acting_V[h], hands[h].place_V() - from_V[h]);
      ++ticks;
      most_j = std::max(most_j, put_in_j);
      EXPECT_GT(put_in_j, -late_j - 1e-9) << time_s;
      each();
    }
  }
  void count_energy(std::size_t h, const Vec3& acting_V, const Vec3& way_V) {
    put_in_j -= acting_V.dot(way_V);
    acted_V[h][ticks % kLate_ticks] = acting_V;
    double change_n = 0;
    for (const Vec3& before_V : acted_V[h])
      change_n = std::max(change_n, (acting_V - before_V).norm());
    late_j += change_n * way_V.norm();
  }
  Vec3 motors_W(std::size_t h) const {
    return testing::turned_mapping().X_WV.q * hands[h].motors_V();
  }
  const Vec3& felt_W(std::size_t h) const { return loops.session.tool_state(h).force_W; }

  StubLibrary& stub;
  std::array<Squeezer, 2>& hands;
  std::array<ProbePath, 2> paths;
  TwoLoops loops;
  double time_s = 0;
  // A force acts after a report or servo pass to the program, a tick by which one hand knows the
  // other late, and a report or pass to the motors.
  static constexpr std::size_t kLate_ticks = 4;
  std::size_t ticks = 0;
  // What both hands have put into the motors and not got back, and what a force that comes late
  // lets out beyond that: by as much as it changes meanwhile.
  double put_in_j = 0, late_j = 0, most_j = 0;
  std::array<std::array<Vec3, kLate_ticks>, 2> acted_V = at_rest();
  static std::array<std::array<Vec3, kLate_ticks>, 2> at_rest() {
    std::array<std::array<Vec3, kLate_ticks>, 2> none;
    for (auto& of_hand : none) of_hand.fill(Vec3::Zero());
    return none;
  }
};

// What the two squeeze with once all is at rest. Whatever they differ by, the bone's spring holds:
// its force is stiffness times way.
void expect_rest(SqueezeRun& run, double wanted_n) {
  const double way_m = run.loops.session.bones().bones[0].X_WB.p.x();
  const double left_n = run.motors_W(0).x(), right_n = run.motors_W(1).x();
  std::printf("left %.3f N, right %.3f N, the bone has gone %.4f mm\n", left_n, right_n,
              1e3 * way_m);
  EXPECT_NEAR(left_n, -wanted_n, 0.05 * wanted_n);
  EXPECT_NEAR(right_n, wanted_n, 0.05 * wanted_n);
  EXPECT_NEAR(left_n + right_n, -SqueezeRun::settings().physics.spring_n_per_m * way_m, 0.1);
  EXPECT_LT(std::abs(way_m), 1e-3);
  for (std::size_t h = 0; h < 2; ++h)
    EXPECT_EQ(run.loops.cause(h), ForceOff::kNone) << describe(run.loops.cause(h));
}

// Nothing has come out of the motors, over both hands, that was not put in before, in no moment,
// but for what their own delay lets out; run_to looks at each tick. At the end both have left.
void expect_energy_bound(const SqueezeRun& run) {
  std::printf("energy put in: most %.1f uJ, at the end %.1f uJ; let out by delay at most %.1f uJ\n",
              1e6 * run.most_j, 1e6 * run.put_in_j, 1e6 * run.late_j);
  EXPECT_GT(run.most_j, 1e-4);
  EXPECT_LT(run.late_j, 0.2 * run.most_j);
  EXPECT_TRUE(run.motors_W(0).isZero(1e-9));
  EXPECT_TRUE(run.motors_W(1).isZero(1e-9));
}

// In the last quarter second before they leave: but for a step or two of a device's position.
constexpr double kStep_n = 0.02;
void expect_calm(
    SqueezeRun& run, const std::function<void()>& each = [] {}) {
  const double left_n = run.motors_W(0).x(), right_n = run.motors_W(1).x();
  run.run_to(3, [&] {
    ASSERT_NEAR(run.motors_W(0).x(), left_n, kStep_n) << run.time_s;
    ASSERT_NEAR(run.motors_W(1).x(), right_n, kStep_n) << run.time_s;
    each();
  });
}

void expect_bone_in_balance(StubLibrary& stub, std::array<Squeezer, 2> hands) {
  const Squeeze squeeze = of_a_bone();
  SqueezeRun run(stub, hands, squeeze);
  run.run_to(2.75);
  expect_calm(run);
  expect_rest(run, squeeze.wanted_n);
  for (std::size_t h = 0; h < 2; ++h)
    EXPECT_GT(run.loops.session.tool_state(h).contact_count, 0u) << h;
  run.run_to(4.5);
  expect_energy_bound(run);
}

// By how much a tick of the hands' ways and speeds changes what they feel of each other: the wall
// between them stands in the middle.
double change_in_a_tick(const std::array<ToolState, 2>& before, const Session& session) {
  const HapticParams haptic = testing::RunLoop::settings().haptic;
  double change_n = 0;
  for (std::size_t h = 0; h < 2; ++h) {
    const ToolState& now = session.tool_state(h);
    change_n += 0.5 * haptic.stiffness_n_per_m * (now.X_WD.p - before[h].X_WD.p).norm() +
                haptic.damping_n_s_per_m * (now.v_W - before[h].v_W).norm();
  }
  return change_n;
}

// In every tick the forces differ by no more than a tick changes: each hand knows the other late by
// one.
void expect_tools_in_balance(StubLibrary& stub, std::array<Squeezer, 2> hands) {
  const Squeeze squeeze = of_each_other();
  SqueezeRun run(stub, hands, squeeze);
  const Session& session = run.loops.session;
  std::array<ToolState, 2> before{session.tool_state(0), session.tool_state(1)};
  int felt = 0;
  double worst_n = 0;
  const auto compare = [&] {
    const double gap_n = (run.felt_W(0) + run.felt_W(1)).norm();
    ASSERT_LE(gap_n, change_in_a_tick(before, session) + 1e-6) << run.time_s;
    worst_n = std::max(worst_n, gap_n);
    felt += run.felt_W(0).isZero(0) ? 0 : 1;
    before = {session.tool_state(0), session.tool_state(1)};
  };
  run.run_to(2.75, compare);
  expect_calm(run, compare);
  expect_rest(run, squeeze.wanted_n);
  EXPECT_EQ(session.tool_state(0).tool_contact_count, 1u);
  EXPECT_EQ(session.tool_state(0).contact_count, 0u);
  run.run_to(4.5, compare);
  std::printf("the two forces differ by %.4f N at most, in a tick\n", worst_n);
  EXPECT_GT(felt, 1500);
  expect_energy_bound(run);
}

// Each takes the arms where a hand waits beside the block.
void bring_to_start(StubLibrary& stub, std::array<Squeezer, 2>& hands) {
  for (int i = 0; i < 500; ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      hands[h].lead(testing::wanted_in_V(from_side(h == 0 ? -1 : 1, 14), 0));
      (void)hands[h].device->read();
    }
    stub.step(1);
  }
}

std::array<Squeezer, 2> two_arms(StubLibrary& stub) {
  const auto session = stub.session();
  std::array<Squeezer, 2> hands = {arm(stub, session, true), arm(stub, session, false)};
  bring_to_start(stub, hands);
  return hands;
}

std::array<Squeezer, 2> two_joysticks(StubLibrary& stub) {
  std::array<Squeezer, 2> hands = {joystick(JoystickDialectKind::kVector),
                                   joystick(JoystickDialectKind::kPid)};
  bring_to_start(stub, hands);
  return hands;
}

std::array<Squeezer, 2> arm_and_joystick(StubLibrary& stub) {
  std::array<Squeezer, 2> hands = {arm(stub, stub.session(), true),
                                   joystick(JoystickDialectKind::kVector)};
  bring_to_start(stub, hands);
  return hands;
}

TEST(Squeeze, ABoneByTwoPhantomArms) {
  StubLibrary stub;
  expect_bone_in_balance(stub, two_arms(stub));
}

TEST(Squeeze, ABoneByTwoJoysticks) {
  StubLibrary stub;
  expect_bone_in_balance(stub, two_joysticks(stub));
}

TEST(Squeeze, ABoneByAPhantomArmAndAJoystick) {
  StubLibrary stub;
  expect_bone_in_balance(stub, arm_and_joystick(stub));
}

TEST(Squeeze, EachOtherByTwoPhantomArms) {
  StubLibrary stub;
  expect_tools_in_balance(stub, two_arms(stub));
}

TEST(Squeeze, EachOtherByTwoJoysticks) {
  StubLibrary stub;
  expect_tools_in_balance(stub, two_joysticks(stub));
}

TEST(Squeeze, EachOtherByAPhantomArmAndAJoystick) {
  StubLibrary stub;
  expect_tools_in_balance(stub, arm_and_joystick(stub));
}

// The one is unplugged in the middle of it: its instrument stays where it was, so that the other
// hand feels what it felt.
TEST(Squeeze, AFaultOfOneIsNotFeltByTheOther) {
  for (const Squeeze& squeeze : {of_a_bone(), of_each_other()}) {
    StubLibrary stub;
    std::array<Squeezer, 2> hands = arm_and_joystick(stub);
    SqueezeRun run(stub, hands, squeeze);
    run.run_to(2.5);
    const double before_n = run.motors_W(1).x();
    ASSERT_GT(before_n, 0.9 * squeeze.wanted_n);
    hands[0].unplug();
    run.run_to(2.9, [&] {
      ASSERT_TRUE(run.motors_W(0).isZero(0)) << run.time_s;
      ASSERT_NEAR(run.motors_W(1).x(), before_n, 0.005) << run.time_s;
    });
    EXPECT_EQ(run.loops.cause(0), ForceOff::kDisconnect);
    EXPECT_EQ(run.loops.cause(1), ForceOff::kNone);
  }
}

}  // namespace
}  // namespace osteon
