// A meniscus in a session: a block that lies on a bone, pressed, hooked and left alone.
#include <gtest/gtest.h>

#include <cmath>

#include "count_allocations.h"
#include "osteon/base/random.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::allocations;

using testing::begin_recording;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::kBlockTop_m;
using testing::keep_tick;
using testing::kMeniscus_n_per_m;
using testing::MeniscusRun;

const MeniscusRun& the_run() { return testing::meniscus_run(); }

ToolInput ball_at(const Vec3& p, double v_z = 0) {
  ToolInput input;
  input.X_WD.p = p;
  input.v_W = {0, 0, v_z};
  return input;
}

// In 0.3 s from `from` to `to`, then it rests there.
void bring(Session& session, const Vec3& from, const Vec3& to, int ticks = 600,
           std::vector<Event>* events = nullptr) {
  for (int n = 1; n <= ticks; ++n) {
    (void)session.tick(ball_at(from + std::min(1.0, n / 300.0) * (to - from)));
    if (!events) continue;
    for (const Event& event : session.last_events()) events->push_back(event);
  }
}

Vec3 over_block(double x, double y, double deep_m) { return {x, y, kBlockTop_m - deep_m}; }

std::size_t told_count(const std::vector<Event>& events, EventKind kind) {
  return static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(), [kind](const Event& event) { return event.kind == kind; }));
}

TEST(SoftSolid, PalpatedItIsAsStiffAsTheTissueTableSays) {
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.004, 0.002, 0), Vec3(-0.008, -0.005, 0)}) {
    Session session = the_run().session();
    double force[2] = {};
    for (int i = 0; i < 2; ++i) {
      bring(session, over_block(at.x(), at.y(), i ? 0.0005 : -0.002),
            over_block(at.x(), at.y(), 0.0005 + i * 0.001));
      force[i] = session.tool_state().force_W.z();
    }
    EXPECT_NEAR((force[1] - force[0]) / 0.001, kMeniscus_n_per_m, 0.15 * kMeniscus_n_per_m)
        << at.transpose();
    EXPECT_NEAR(session.tool_state().force_W.head<2>().norm(), 0, 0.05 * force[1]);
  }
}

// A hook from below lifts it: the force holds the tool back, and gives way more than from above.
TEST(SoftSolid, HookedFromBelowItHoldsBackAndYieldsMore) {
  Session session = the_run().session();
  const double under = -kBlockTop_m;
  bring(session, {0.002, 0, under - 0.002}, {0.002, 0, under + 0.006});
  const double pull = session.tool_state().force_W.z();
  EXPECT_LT(pull, -1);
  EXPECT_GT(pull, -0.95 * kMeniscus_n_per_m * 0.006);
  // Through the whole block at rest: it stays on its side.
  bring(session, {0.002, 0, under + 0.006}, {0.002, 0, under + 0.009});
  EXPECT_LT(session.tool_state().force_W.z(), pull);
}

// How far the middle of that side goes up: -1 the one on the tibia's cartilage, 1 the free one.
double side_goes(const Session& session, double side) {
  const SoftSolid& solid = the_run().softs->solids[0];
  const Pose X_BW = the_run().the_case->bone(solid.bone).X_WB.inverse();
  const SoftPushes now = session.softs()->pushes();
  std::vector<SolidPush> pushes;
  for (std::uint32_t i = 0; i < now.count; ++i)
    pushes.push_back(solid.body->push_at(now.all[i].p_B, now.all[i].nhat_B, now.all[i].force_n));
  const Vec3 at_W(0.004, 0.002, side * testing::kMeniscusHalf.z());
  return PressedSolid::moved_at(solid.body->patch_at(X_BW * at_W), solid.body->moved(pushes)).z();
}

// A meniscus that is pressed by 5 mm does not go into the cartilage that it lies on; lifted as far
// it comes off it.
TEST(SoftSolid, PressedItStaysOnTheCartilageUnderItAndLiftedItComesOff) {
  Session pressed = the_run().session();
  bring(pressed, over_block(0.004, 0.002, -0.002), over_block(0.004, 0.002, 0.005));
  EXPECT_GT(pressed.tool_state().force_W.z(), 1.5);
  EXPECT_LT(side_goes(pressed, 1), -1e-3);
  EXPECT_GT(side_goes(pressed, -1), -1e-4);
  Session lifted = the_run().session();
  const Vec3 under(0.004, 0.002, -kBlockTop_m);
  bring(lifted, under - Vec3(0, 0, 0.002), under + Vec3(0, 0, 0.005));
  EXPECT_LT(lifted.tool_state().force_W.z(), -0.5);
  EXPECT_GT(side_goes(lifted, -1), 1e-3);
}

TEST(SoftSolid, WhatBeginsInsideIsNotFeltBeforeItHasBeenOut) {
  Session session = the_run().session();
  for (int n = 0; n < 100; ++n) (void)session.tick(ball_at({0, 0, 0}));
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  bring(session, {0, 0, 0}, over_block(0, 0, -0.002));
  bring(session, over_block(0, 0, -0.002), over_block(0, 0, 0.002));
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

TEST(SoftSolid, EventsNameThePartAndEndWithThePeak) {
  Session session = the_run().session();
  std::vector<Event> events;
  bring(session, over_block(0, 0, -0.002), over_block(0, 0, 0.004), 600, &events);
  ASSERT_EQ(told_count(events, kSoftBegin), 1u);
  EXPECT_EQ(told_count(events, kSoftEnd), 0u);
  const double peak = session.softs()->solid_readout(0).force_n[0];
  bring(session, over_block(0, 0, 0.004), over_block(0, 0, -0.004), 600, &events);
  ASSERT_EQ(told_count(events, kSoftEnd), 1u);
  const Event& end = events.back();
  EXPECT_EQ(end.subject_kind, SubjectKind::kSoftPart);
  EXPECT_EQ(the_run().the_case->softs[end.subject].name, "medial_meniscus");
  EXPECT_NEAR(end.values[1], peak, 0.01 * peak);
  EXPECT_NEAR(end.values[2], 4, 0.1);
}

// A slow press of 1 Hz that slides along the block: the force comes and goes without steps.
TEST(SoftSolid, ASlowPressHasNoSteps) {
  Session session = the_run().session();
  double last = 0, peak = 0, step = 0;
  for (int n = 0; n < 1000; ++n) {
    const double turn = 2 * std::numbers::pi * 1e-3 * n;
    const double z = kBlockTop_m + 0.0005 - 0.00175 * (1 - std::cos(turn));
    (void)session.tick(
        ball_at({0.004 * std::sin(turn), 0, z}, -0.00175 * 2 * std::numbers::pi * std::sin(turn)));
    const double force = session.tool_state().force_W.norm();
    if (n > 0) step = std::max(step, std::abs(force - last));
    last = force;
    peak = std::max(peak, force);
  }
  EXPECT_GT(peak, 1.5);
  EXPECT_LT(step, 0.02 * peak);
}

// What presses it is where the tool is: the shape that is drawn has gone down by as much there.
TEST(SoftSolid, ItsShapeFollowsTheTool) {
  Session session = the_run().session();
  bring(session, over_block(0.003, 0, -0.002), over_block(0.003, 0, 0.003));
  const SoftPushes pushes = session.softs()->pushes();
  ASSERT_EQ(pushes.count, 1u);
  const PressedSolid& body = *the_run().softs->solids[0].body;
  const SolidPush push =
      body.push_at(pushes.all[0].p_B, pushes.all[0].nhat_B, pushes.all[0].force_n);
  const auto moved = body.moved(std::span(&push, 1));
  EXPECT_NEAR(-push.nhat.dot(PressedSolid::moved_at(push.patch, moved)), 0.003, 5e-5);
}

// No tool near: the part sleeps, and its state is the same bits as if none had ever come.
TEST(SoftSolid, SleepsWhereNoToolIsNearAndWakesTheSame) {
  Session session = the_run().session();
  const Vec3 far(0, 0, 0.030);
  (void)session.tick(ball_at(far));
  (void)session.tick(ball_at(far));
  EXPECT_TRUE(session.softs()->is_asleep(0));
  const std::uint64_t rest = session.softs()->hash();
  bring(session, over_block(0, 0, -0.002), over_block(0, 0, 0.002));
  EXPECT_FALSE(session.softs()->is_asleep(0));
  EXPECT_NE(session.softs()->hash(), rest);
  bring(session, over_block(0, 0, 0.002), far);
  EXPECT_TRUE(session.softs()->is_asleep(0));
  EXPECT_EQ(session.softs()->hash(), rest);
  EXPECT_EQ(session.softs()->pushes().count, 0u);
}

TEST(SoftSolid, AStateGivesTheSameBitsAfterwards) {
  const MeniscusRun& run = the_run();
  Session session = run.session();
  bring(session, over_block(0, 0, -0.002), over_block(0.004, 0, 0.003), 300);
  Session other = run.session();
  const SessionState back = go_on_as(other, session);
  for (Session* s : {&session, &other})
    bring(*s, over_block(0.004, 0, 0.003), over_block(-0.004, 0.002, 0.002));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.tool_state().force_W, session.tool_state().force_W);
  EXPECT_GT(other.tool_state().force_W.z(), 1);
  Session without(run.the_case, run.settings, run.tray, nullptr, nullptr);
  EXPECT_FALSE(without.restore(back));
}

ToolInput roaming(Random& random, Vec3& at) {
  at += 0.0012 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  at = at.cwiseMax(Vec3(-0.018, -0.013, -0.010)).cwiseMin(Vec3(0.018, 0.013, 0.010));
  return ball_at(at);
}

TEST(SoftSolid, AReplayIsTheSameFromTheStartAndFromTheMiddle) {
  const MeniscusRun& run = the_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  Random random(5);
  Vec3 at(0, 0, 0.008);
  std::size_t touched = 0;
  for (std::uint64_t n = 1; n <= 2000; ++n) {
    (void)session.tick(roaming(random, at));
    keep_tick(recording, session, 500);
    touched += session.tool_state().force_W.isZero(0) ? 0 : 1;
  }
  EXPECT_GT(touched, 100u);
  expect_same_replays(recording, run, session, {0.0, 1.2});
}

TEST(SoftSolid, WildHandsGetAFiniteForceAndNothingIsAllocated) {
  Session session = the_run().session();
  Random random(9);
  Vec3 at(0, 0, 0.01);
  for (std::uint64_t n = 1; n <= 6000; ++n) {
    ToolInput input = roaming(random, at);
    if (n % 701 == 0) input.X_WD.p.z() = std::nan("");
    const std::uint64_t before = allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones());
    ASSERT_EQ(allocations(), before) << n;
    ASSERT_TRUE(is_finite(tool.force_W));
    if (n % 2 == 0) (void)session.physics_step(tool);
    ASSERT_EQ(allocations(), before) << n;
  }
}

TEST(SoftSolid, SaysWhatTheCaseLacks) {
  const auto none = make_soft_solids(*testing::two_box_case(), std::vector<std::string>{"menisci"},
                                     kMeniscus_n_per_m);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("no meniscus"), std::string::npos);
  EXPECT_FALSE(names_solids(*the_run().the_case, "acl"));
  EXPECT_TRUE(names_solids(*the_run().the_case, "medial_meniscus"));
}

}  // namespace
}  // namespace osteon
