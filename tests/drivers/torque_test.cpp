// The moment of what an instrument meets, from the session's tick through the gate to a device.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/loops/fake_device.h"
#include "count_allocations.h"
#include "loops/haptic_stage.h"
#include "loops/physics_stage.h"
#include "osteon/scene/tool_moment.h"

namespace osteon {
namespace {

constexpr double kSkin_m = 0.03;

/// Drives all rotations, far above what a test gives.
struct SixAxesDevice : HapticDevice {
  SixAxesDevice() {
    device.name = "six axes";
    device.peak_force_n = device.continuous_force_n = 8;
    device.max_stiffness_n_per_m = 3000;
    device.torque_axes = {true, true, true};
    device.peak_torque_nm = device.continuous_torque_nm = 1;
    device.max_torque_slew_nm_per_s = 500;
  }
  const DeviceInfo& info() const override { return device; }
  DeviceSample read() override {
    sample.time_ns += 1'000'000;
    return sample;
  }
  void write_force(const Vec3& force_V) override {
    given = {force_V, next_V};
    next_V.setZero();
  }
  void write_torque(const Vec3& torque_V) override { next_V = torque_V; }
  void close() override {}

  DeviceInfo device;
  DeviceSample sample;
  DeviceWrench given;
  Vec3 next_V = Vec3::Zero();
};

// A block far below a skin with one hole; inwards is down.
std::shared_ptr<const Case> block_under_skin() {
  CaseDef def;
  def.name = "block under skin";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = test::box(Vec3::Constant(0.01));
  bone.X_WB.p = Vec3(0, 0, -0.1);
  def.bones.push_back(bone);
  def.landmarks.push_back({"portal_a", {0, 0, kSkin_m}});
  return std::make_shared<const Case>(build_case(std::move(def)).value());
}

Tray long_shaft() {
  Tool tool;
  tool.name = "shaft";
  tool.shaft = {Vec3(0, 0, 0.001), Vec3(0, 0, 0.15), 0.001};
  tool.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), 0.001));
  tool.parts.push_back(make_rod(tool.shaft.p0, tool.shaft.p1, 0.001));
  return {std::make_shared<const Tool>(tool)};
}

SessionSettings with_shaft() {
  SessionSettings settings;
  settings.tray = {"shaft"};
  return settings;
}

HapticStageOptions without_passivity(const DeviceMapping& mapping) {
  HapticStageOptions options;
  options.mapping = mapping;
  options.safety.passivity.on = false;
  return options;
}

// One device's loops in one thread.
struct TorqueLoop {
  TorqueLoop(std::shared_ptr<const Case> the_case, SixAxesDevice& the_device,
             const DeviceMapping& mapping = {})
      : device(the_device),
        session(std::move(the_case), with_shaft(), long_shaft()),
        exchange(session.bones()),
        haptic(session, device, without_passivity(mapping), exchange, nullptr),
        physics(session, exchange, nullptr) {
    exchange.to_gate.push(GateWish::kEnable);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      haptic.step();
      if (i % 2 == 1) physics.step();
    }
  }
  // From above the skin through the hole to that depth of the tip, and 0.6 s of rest: the ramp.
  void enter(double tip_z) {
    for (int i = 0; i <= 300; ++i) {
      device.sample.X_VD.p.z() = kSkin_m + 0.02 - (kSkin_m + 0.02 - tip_z) * i / 300;
      run(2);
    }
    run(600);
  }
  void pull_sideways(double to_m) {
    for (int i = 0; i <= 100; ++i) {
      device.sample.X_VD.p.x() = to_m * i / 100;
      run(2);
    }
    run(300);
  }
  const ToolState& tool() const { return session.tool_state(0); }

  SixAxesDevice& device;
  Session session;
  LoopExchange exchange;
  HapticStage haptic;
  PhysicsStage physics;
};

// A turning hand whose shaft is held in the hole: the tip cannot go sideways but the shaft swings,
// so what pushes it is turned by the device's own rotation. The hole holds at a distance d from the
// tip: the moment about the tip is the force there times d.
TEST(Torque, OfAShaftInAPortalIsForceTimesDistance) {
  SixAxesDevice device;
  TorqueLoop loop(block_under_skin(), device);
  loop.enter(0.005);
  EXPECT_EQ(loop.tool().portal, 0u);
  loop.pull_sideways(0.003);
  const Vec3 force = device.given.force_V;
  ASSERT_GT(std::abs(force.x()), 0.2) << force.transpose();
  const double d = kSkin_m - loop.tool().X_WP.p.z();
  EXPECT_GT(d, 0.02);
  // F acts in the hole, above the tip: (0, 0, d) x F.
  const Vec3 expected = (Vec3(0, 0, kSkin_m) - loop.tool().X_WP.p).cross(force);
  EXPECT_NEAR(device.given.torque_V.y(), d * force.x(), 0.05 * std::abs(d * force.x()));
  EXPECT_LT((device.given.torque_V - expected).norm(), 1e-9);
  // Let go: none.
  loop.pull_sideways(0);
  EXPECT_LT(device.given.torque_V.norm(), 0.05 * expected.norm());
}

// The hand on the other side, through a device that stands turned by a quarter: force and torque
// turn with it, and their sense is the opposite of the first.
TEST(Torque, TurnsWithTheDevicesAxesAndWithTheSide) {
  const auto pressed = [](double to_m, const DeviceMapping& mapping) {
    SixAxesDevice device;
    TorqueLoop loop(block_under_skin(), device, mapping);
    device.sample.X_VD.q = mapping.X_WV.q.conjugate();
    const auto place = [&](const Vec3& p_W) {
      device.sample.X_VD.p = mapping.X_WV.q.conjugate() * p_W;
    };
    for (int i = 0; i <= 300; ++i) {
      place(Vec3(0, 0, kSkin_m + 0.02 - 0.045 * i / 300));
      loop.run(2);
    }
    loop.run(600);
    for (int i = 0; i <= 100; ++i) {
      place(Vec3(to_m * i / 100, 0, 0.005));
      loop.run(2);
    }
    loop.run(300);
    return DeviceWrench{mapping.X_WV.q * device.given.force_V,
                        mapping.X_WV.q * device.given.torque_V};
  };
  DeviceMapping turned;
  turned.X_WV.q = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  const DeviceWrench right = pressed(0.003, {});
  const DeviceWrench again = pressed(0.003, turned);
  const DeviceWrench left = pressed(-0.003, {});
  ASSERT_GT(right.torque_V.norm(), 0.005);
  EXPECT_LT((right.torque_V - again.torque_V).norm(), 1e-6);
  EXPECT_LT((right.torque_V + left.torque_V).norm(), 1e-3 * right.torque_V.norm() + 1e-6);
}

// Two rods pressed together by two hands: what one bears about a common point the other bears the
// other way round. The point where they touch is one, the forces are opposite.
TEST(Torque, OfTwoToolsThatPushEachOtherIsOpposite) {
  ToolState left, right;
  for (ToolState* s : {&left, &right}) {
    s->tool_contact_count = 1;
    s->tool_contacts[0].p_W = Vec3(0.01, 0.02, 0.05);
  }
  left.force_W = left.tool_contacts[0].force_on_tool_W = Vec3(0, 3, 0);
  right.force_W = right.tool_contacts[0].force_on_tool_W = Vec3(0, -3, 0);
  const Vec3 about(0.1, 0, 0);
  EXPECT_EQ(moment_about(about, left, {}), Vec3(-moment_about(about, right, {})));
  EXPECT_LT((moment_about(about, left, {}) - Vec3(-0.15, 0, -0.27)).norm(), 1e-15);
}

TEST(Torque, WithAFaultOrAtTheEndItIsZeroAtOnce) {
  for (const bool fault : {true, false}) {
    SixAxesDevice device;
    TorqueLoop loop(block_under_skin(), device);
    loop.enter(0.005);
    loop.pull_sideways(0.003);
    ASSERT_GT(device.given.torque_V.norm(), 0.003);
    if (fault) {
      device.sample.w_V.x() = std::numeric_limits<double>::quiet_NaN();
      loop.run(1);
    } else {
      loop.haptic.force_to_zero();
    }
    EXPECT_EQ(device.given.torque_V, Vec3::Zero());
    EXPECT_EQ(device.given.force_V, Vec3::Zero());
    loop.run(5);
    EXPECT_EQ(device.given.torque_V, Vec3::Zero());
  }
}

TEST(Torque, NeverExceedsTheDevicesLimit) {
  SixAxesDevice device;
  device.device.peak_torque_nm = device.device.continuous_torque_nm = 0.002;
  TorqueLoop loop(block_under_skin(), device);
  loop.enter(0.005);
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    device.sample.X_VD.p.x() = 0.004 * std::sin(0.02 * i);
    loop.run(2);
    most = std::max(most, device.given.torque_V.norm());
  }
  EXPECT_LE(most, 0.002 + 1e-15);
  EXPECT_GT(most, 0.0019);
}

TEST(Torque, ATickAllocatesNothing) {
  SixAxesDevice device;
  TorqueLoop loop(block_under_skin(), device);
  loop.enter(0.005);
  loop.pull_sideways(0.002);
  const std::uint64_t before = testing::allocations();
  for (int i = 0; i < 200; ++i) {
    device.sample.X_VD.p.x() = 0.002 + 1e-5 * i;
    loop.haptic.step();
    loop.physics.step();
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(device.given.torque_V.norm(), 0.001);
}

}  // namespace
}  // namespace osteon
