// Instruments that slide over soft parts: stick and slip, against the closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "recorded_run.h"
#include "soft_fixtures.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::go_on_as;

constexpr SoftFriction kOnSofts{{0.06, 0.04}, {0.08, 0.05}};

std::shared_ptr<const SoftSetup> rubbing(const SoftSetup& smooth) {
  SoftSetup setup = smooth;
  add_friction(setup, kOnSofts);
  return std::make_shared<const SoftSetup>(std::move(setup));
}

Session rubbing_block() {
  const testing::MeniscusRun& run = testing::meniscus_run();
  static const std::shared_ptr<const SoftSetup> softs = rubbing(*run.softs);
  SessionSettings settings = run.settings;
  settings.soft_hash = softs->hash;
  return Session(run.the_case, settings, run.tray, nullptr, softs);
}

ToolInput moving_ball(const Vec3& p, const Vec3& v) {
  ToolInput input;
  input.X_WD.p = p;
  input.v_W = v;
  return input;
}

// Down within 0.3 s at x, 2.5 mm deep, and left there.
void press_block(Session& session, double x) {
  const double top = testing::kBlockTop_m;
  for (int n = 0; n <= 400; ++n)
    (void)session.tick(
        moving_ball({x, 0, top + 0.001 - 0.0035 * std::min(1.0, n / 300.0)}, Vec3::Zero()));
}

struct Drag {
  double held_n_per_m = 0;   // of friction by way, before it slips
  double most = 0, end = 0;  // of friction by push
  double longest_step = 0;   // of the force by its own peak
  double up = 0;             // friction where it slides, towards +x
};

// By 4 mm at 10 mm/s.
Drag drag(Session& session, double from_x, double way) {
  Drag out;
  const double z = session.tool_state().X_WD.p.z(), v = way < 0 ? -0.01 : 0.01;
  Vec3 last = session.tool_state().force_W;
  double peak = last.norm(), step = 0;
  const double first = last.x();
  for (int n = 1; n <= 400; ++n) {
    (void)session.tick(moving_ball({from_x + n * 1e-3 * v, 0, z}, {v, 0, 0}));
    const Vec3& force = session.tool_state().force_W;
    const double ratio = std::abs(force.x()) / force.z();
    if (n == 3) out.held_n_per_m = (first - force.x()) / (3e-3 * v);
    out.most = std::max(out.most, ratio);
    out.end = ratio;
    out.up = force.x();
    peak = std::max(peak, force.norm());
    step = std::max(step, (force - last).norm());
    last = force;
  }
  out.longest_step = step / peak;
  return out;
}

// The top of the block is flat: what comes sideways from the solid itself is taken off by going
// both ways.
TEST(SoftFriction, AMeniscusHoldsSlipsAndSlidesByTheTablesRatios) {
  Session session = rubbing_block();
  press_block(session, -0.002);
  const Drag there = drag(session, -0.002, 1);
  EXPECT_NEAR(there.most, kOnSofts.solid.resting, 0.05 * kOnSofts.solid.resting);
  EXPECT_NEAR(there.end, kOnSofts.solid.sliding, 0.1 * kOnSofts.solid.sliding);
  EXPECT_LT(there.longest_step, 0.02);
  EXPECT_LT(there.up, 0) << "against the way";
  const Drag back = drag(session, 0.002, -1);
  EXPECT_GT(back.up, 0);
  EXPECT_NEAR(back.end, kOnSofts.solid.sliding, 0.1 * kOnSofts.solid.sliding);
  EXPECT_LT(back.longest_step, 0.02);
}

TEST(SoftFriction, WhatIsHeldComesBack) {
  Session session = rubbing_block();
  press_block(session, 0);
  const double z = session.tool_state().X_WD.p.z();
  // 50 um of the 90 that friction of 2.2 N holds.
  for (int n = 1; n <= 200; ++n)
    (void)session.tick(moving_ball({5e-5 * std::min(1.0, n / 100.0), 0, z}, Vec3::Zero()));
  const HapticParams params = testing::meniscus_run().settings.haptic;
  EXPECT_NEAR(session.tool_state().force_W.x(), -5e-5 * params.stiffness_n_per_m, 0.01);
  for (int n = 1; n <= 200; ++n)
    (void)session.tick(moving_ball({5e-5 * std::max(0.0, 1 - n / 100.0), 0, z}, Vec3::Zero()));
  EXPECT_NEAR(session.tool_state().force_W.x(), 0, 0.01);
}

// Along the ligament: the shaft presses across it and is drawn over it.
TEST(SoftFriction, ALigamentRubsToo) {
  testing::BandRun run;
  run.softs = rubbing(*run.softs);
  run.settings.soft_hash = run.softs->hash;
  Session session = run.session();
  for (int n = 0; n <= 400; ++n)
    (void)session.tick(
        testing::shaft_at(testing::kTouch_m + 0.001 - 0.004 * std::min(1.0, n / 300.0)));
  double most = 0, end = 0;
  for (int n = 1; n <= 300; ++n) {
    (void)session.tick(testing::shaft_at(testing::kTouch_m - 0.003, 0, n * 5e-6));
    const Vec3& force = session.tool_state().force_W;
    end = -force.x() / force.z();
    most = std::max(most, end);
  }
  EXPECT_NEAR(most, kOnSofts.band.resting, 0.05 * kOnSofts.band.resting);
  EXPECT_NEAR(end, kOnSofts.band.sliding, 0.1 * kOnSofts.band.sliding);
}

TEST(SoftFriction, AStateInTheMiddleOfASlideGivesTheSameBits) {
  Session session = rubbing_block();
  press_block(session, -0.002);
  (void)drag(session, -0.002, 1);
  Session other = rubbing_block();
  (void)go_on_as(other, session);
  for (Session* s : {&session, &other}) (void)drag(*s, 0.002, -1);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.tool_state().force_W, session.tool_state().force_W);
}

TEST(SoftFriction, WithoutItTheSetupIsTheSame) {
  SoftSetup setup = *testing::meniscus_run().softs;
  const std::uint64_t before = setup.hash;
  add_friction(setup, {});
  EXPECT_EQ(setup.hash, before);
  add_friction(setup, kOnSofts);
  EXPECT_NE(setup.hash, before);
}

}  // namespace
}  // namespace osteon
