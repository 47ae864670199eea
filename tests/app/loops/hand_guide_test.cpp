#include "loops/hand_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/loops/fake_device.h"
#include "app/loops/runtime_rig.h"

namespace osteon {
namespace {

constexpr double kTick_s = 0.001;

GuideLine along_x(double strength = 1) {
  return {true, Vec3(0.001, 0, 0), Vec3::UnitX(), strength};
}

// After so long that nothing is left of a jump.
Vec3 settled(HandGuide& guide, const GuideLine& line, const Vec3& tip_W) {
  Vec3 force_W = Vec3::Zero();
  for (int i = 0; i < 2000; ++i) force_W = guide.force_W(line, tip_W, kTick_s);
  return force_W;
}

TEST(HandGuide, LeadsNobodyUntilThereIsALine) {
  HandGuide guide;
  EXPECT_EQ(guide.force_W({}, Vec3(1, 2, 3), kTick_s), Vec3::Zero());
}

TEST(HandGuide, NonsenseGivesNoForceAndIsForgotten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HandGuide guide;
  settled(guide, along_x(), Vec3(0, 0.005, 0));
  GuideLine bad = along_x();
  bad.p_W.x() = nan;
  EXPECT_EQ(guide.force_W(bad, Vec3(0, 0.005, 0), kTick_s), Vec3::Zero());
  EXPECT_EQ(guide.force_W(along_x(), Vec3(0, nan, 0), kTick_s), Vec3::Zero());
  EXPECT_EQ(guide.force_W(along_x(2), Vec3(0, 0.005, 0), kTick_s), Vec3::Zero());
  EXPECT_EQ(guide.force_W(along_x(nan), Vec3(0, 0.005, 0), kTick_s), Vec3::Zero());
}

TEST(HandGuide, IsAWeakSpringAcrossTheLineWithALimit) {
  HandGuide guide;
  // 5 mm beside: 60 N/m times 5 mm, towards the line, and nothing along it.
  EXPECT_NEAR((settled(guide, along_x(), Vec3(0.05, 0.003, 0.004)) - Vec3(0, -0.18, -0.24)).norm(),
              0, 1e-12);
  EXPECT_NEAR(settled(guide, along_x(), Vec3(0, 0, 0.5)).norm(), HandGuide::kMost_n, 1e-12);
  EXPECT_NEAR(settled(guide, along_x(0.25), Vec3(0, 0, 0.5)).norm(), 0.25 * HandGuide::kMost_n,
              1e-12);
  EXPECT_EQ(settled(guide, along_x(0), Vec3(0, 0, 0.5)), Vec3::Zero());
  const GuideLine place{true, Vec3(0.001, 0, 0), Vec3::Zero(), 1};
  EXPECT_NEAR((settled(guide, place, Vec3(0.003, 0, 0)) - Vec3(-0.12, 0, 0)).norm(), 0, 1e-12);
}

TEST(HandGuide, ALineThatJumpsIsFollowedSlowly) {
  HandGuide guide;
  const Vec3 tip_W(0, 0.01, 0);
  double before = 0;
  // 60 N/m times 10 mm, two newtons a second: 0.3 s.
  for (int i = 1; i <= 400; ++i) {
    const double now = guide.force_W(along_x(), tip_W, kTick_s).norm();
    EXPECT_LE(std::abs(now - before), HandGuide::kMostChange_n_per_s * kTick_s + 1e-12);
    EXPECT_NEAR(now, std::min(0.6, 0.002 * i), 1e-9);
    before = now;
  }
  for (int i = 1; i <= 400; ++i)
    EXPECT_NEAR(guide.force_W({}, tip_W, kTick_s).norm(), std::max(0.0, 0.6 - 0.002 * i), 1e-9);
}

TEST(HandGuide, NeverGivesMoreThanItsLimitWhateverTheLineDoes) {
  HandGuide guide;
  for (int i = 0; i < 3000; ++i) {
    GuideLine line = along_x();
    line.p_W = Vec3(0, 0.4 * std::sin(0.37 * i), 0.4 * std::cos(0.11 * i));
    line.along_W = Vec3(std::cos(0.05 * i), std::sin(0.05 * i), 0);
    line.on = i % 7 != 0;
    EXPECT_LE(guide.force_W(line, Vec3(0.3 * std::sin(0.2 * i), 0, 0), kTick_s).norm(),
              HandGuide::kMost_n + 1e-12);
  }
}

// Round and round at rising distances, over the limit too: a line that rests gives nothing away.
TEST(HandGuide, ALineThatRestsGivesNoEnergy) {
  HandGuide guide;
  Vec3 tip_W = Vec3(0, 0.002, 0);
  settled(guide, along_x(), tip_W);
  double work_j = 0, before_j = 0;
  for (int turn = 0; turn < 4; ++turn) {
    for (int i = 1; i <= 1000; ++i) {
      const double a = 2 * 3.14159265358979 * i / 1000, r = 0.002 + 0.028 * std::sin(0.5 * a);
      const Vec3 next_W(0.01 * std::sin(a), r * std::cos(a), r * std::sin(a));
      const Vec3 force_W = guide.force_W(along_x(), 0.5 * (tip_W + next_W), kTick_s);
      work_j += force_W.dot(next_W - tip_W);
      tip_W = next_W;
    }
    EXPECT_NEAR(work_j, before_j, 1e-6) << "back where it began";
    before_j = work_j;
  }
}

// A hand at rest over the blocks, 10 mm beside a line.
struct GuidedStage {
  GuidedStage()
      : loops(std::make_unique<test::FakeDevice>(
            [](std::uint64_t tick) {
              DeviceSample sample;
              sample.time_ns = static_cast<std::int64_t>(tick) * 1'000'000;
              sample.X_VD.p = Vec3(0, 0, 0.03);
              return sample;
            },
            log)) {}
  void wish(bool on) {
    HandWishes wishes;
    wishes.guide = {on, Vec3(0, 0.010, 0.03), Vec3::UnitX(), 1};
    loops.exchange.hand_wishes.publish(wishes);
  }
  double guided_s() { return loops.exchange.device_status.read().guided_s; }

  test::DeviceLog log;
  test::StarvedLoops loops;
};

TEST(HandGuide, ReachesTheDeviceThroughTheSafetyGate) {
  GuidedStage stage;
  stage.loops.run(1000);
  EXPECT_EQ(stage.loops.force_n(), 0) << "nothing is touched";
  for (int picture = 0; picture < 100; ++picture) {
    stage.wish(true);
    stage.loops.run(16);
  }
  EXPECT_NEAR(stage.loops.force_n(), 0.6, 0.01);
  EXPECT_GT(stage.log.forces_V.back().y(), 0.59) << "towards the line";
  EXPECT_NEAR(stage.guided_s(), 1.6, 0.05);
  stage.loops.exchange.to_gate.push(GateWish::kDisable);
  stage.wish(true);
  stage.loops.run(1);
  EXPECT_EQ(stage.loops.force_n(), 0) << "the gate takes it as any other force";
}

TEST(HandGuide, AWindowThatStoppedDrawingLeadsNobody) {
  GuidedStage stage;
  for (int picture = 0; picture < 100; ++picture) {
    stage.wish(true);
    stage.loops.run(16);
  }
  EXPECT_GT(stage.loops.force_n(), 0.5);
  stage.loops.run(700);  // 0.25 s until it counts as gone, 0.3 s to zero
  EXPECT_EQ(stage.loops.force_n(), 0);
}

TEST(HandGuide, TheSessionKnowsNothingOfIt) {
  GuidedStage led, alone;
  for (int picture = 0; picture < 60; ++picture) {
    led.wish(true);
    led.loops.run(16);
    alone.loops.run(16);
  }
  EXPECT_GT(led.loops.force_n(), 0.1);
  EXPECT_EQ(led.loops.session.state_hash(), alone.loops.session.state_hash());
  EXPECT_EQ(led.loops.session.tool_state().force_W, Vec3::Zero());
}

}  // namespace
}  // namespace osteon
