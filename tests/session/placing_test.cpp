// A graft placed in a session: a pin is led and stopped, a clamp hangs on the thread and feels it,
// and everything repeats.
#include <gtest/gtest.h>

#include <cmath>

#include "count_allocations.h"
#include "osteon/base/turn.h"
#include "osteon/physics/graft_placing.h"
#include "osteon/scene/graft.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "osteon/session/session.h"
#include "placing_case.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::go_on_as;

const std::shared_ptr<const Case>& felt_placing() {
  static const std::shared_ptr<const Case> made = testing::placing_knee(true);
  return made;
}

struct PlacingSession {
  PlacingSession() {
    settings.tray = {"passing_pin", "grasper", "clamp"};
    const auto all = load_instruments();
    EXPECT_TRUE(all);
    for (const std::string& name : settings.tray) {
      const Instrument* found = find_instrument(*all, name);
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
    }
    recording.header = recording_header(*felt_placing(), settings, "test", "0", tray);
  }
  Session session() const { return Session(felt_placing(), settings, tray); }
  SessionSettings settings;
  Tray tray;
  Recording recording;
};

// The pin comes in line with the femur's mouth and is pushed on through it and 10 mm farther.
HandInput pin_hand(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double x = t < 0.4 ? -0.02 + 0.0475 * t : t < 0.8 ? -0.001 : -0.001 + 0.05 * (t - 0.8);
  HandInput hand;
  hand.input.X_WD = {Vec3(x, 0, 0), turn_between(Vec3::UnitZ(), Vec3(-Vec3::UnitX()))};
  if (n == 1200) hand.command = {CommandKind::kMark, 1};
  return hand;
}

void push_on(Session& session, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n <= to; ++n) {
    const HandInput hand = pin_hand(n);
    (void)session.tick(std::span(&hand, 1));
  }
}

const GraftPlacingState& placed(const Session& session) { return session.bones().placing; }

TEST(SessionPlacing, ThePinIsLedThroughTheFemurAndFelt) {
  const PlacingSession rig;
  Session session = rig.session();
  push_on(session, 1, 1400);
  EXPECT_GT(placed(session).pin_m, 0.01);
  EXPECT_GT(-session.tool_state().force_W.x(), 0.5 * GraftPlacing::kPin_n);
  const std::size_t before = testing::allocations();
  push_on(session, 1401, 1500);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_EQ(placed(session).phase, PlacingPhase::kEmpty);
  push_on(session, 1501, 2200);
  EXPECT_EQ(placed(session).phase, PlacingPhase::kThreadInside);
}

TEST(SessionPlacing, AStateInTheMiddleGoesOnWithTheSameBits) {
  const PlacingSession rig;
  for (const std::uint64_t stop : {700u, 1500u}) {
    Session session = rig.session();
    push_on(session, 1, stop);
    Session other = rig.session();
    (void)go_on_as(other, session);
    push_on(session, stop + 1, 1800);
    push_on(other, stop + 1, 1800);
    EXPECT_EQ(other.state_hash(), session.state_hash()) << stop;
    SessionState odd = session.save();
    odd.world.bones.placing.on = false;
    EXPECT_FALSE(other.restore(odd));
  }
}

TEST(SessionPlacing, ARecordingRepeatsAndARestorePointPutsThePinBack) {
  PlacingSession rig;
  Session session = rig.session();
  double marked = 0;
  for (std::uint64_t n = 1; n <= 1800; ++n) {
    HandInput hand = pin_hand(n);
    if (n == 1700) hand.command = {CommandKind::kRestore, 1};
    (void)session.tick(std::span(&hand, 1));
    rig.recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) rig.recording.steps.push_back(session.last_step_record());
    if (n == 1200) marked = placed(session).pin_m;
    if (n == 1699) {
      EXPECT_GT(placed(session).pin_m, marked + 0.01);
    }
    if (n == 1704) {
      EXPECT_LE(placed(session).pin_m, marked + 0.001);
    }
  }
  EXPECT_GT(marked, 0.005);
  rig.recording.complete = true;
  ReplayOptions options;
  options.tray = rig.tray;
  const auto again = replay(rig.recording, felt_placing(), options);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
}

// From a state with the thread out: a clamp that shuts on the thread and is drawn away hangs on it.
TEST(SessionPlacing, AClampThatDrawsFeelsTheGraftAndStopsWhenItIsHeldStill) {
  const PlacingSession rig;
  Session session = rig.session();
  SessionState state = session.save();
  state.world.bones.placing.phase = PlacingPhase::kThreadOut;
  ASSERT_TRUE(session.restore(state));
  double most = 0;
  for (std::uint64_t n = 1; n <= 2200; ++n) {
    const double t = static_cast<double>(n) * 0.001;
    HandInput hand;
    const double x = 0.070 + 0.04 * std::clamp(t - 1, 0.0, 0.8);
    hand.input.X_WD = {Vec3(x, 0, 0), turn_between(Vec3::UnitZ(), Vec3(Vec3::UnitX()))};
    if (n == 1) hand.command = {CommandKind::kTake, 2};
    if (n == 300) hand.command = {CommandKind::kJaw, 1};
    if (n == 600) hand.command = {CommandKind::kJaw, 0};
    (void)session.tick(std::span(&hand, 1));
    most = std::max(most, -session.tool_state().force_W.x());
  }
  EXPECT_GT(placed(session).drawn_m, 0.02);
  EXPECT_LT(placed(session).drawn_m, 0.032);
  EXPECT_GT(most, 0.4);
  EXPECT_LT(most, 4);
  EXPECT_NEAR(placed(session).pull_n, GraftPlacing::kLever * -session.tool_state().force_W.x(), 2);
}

// Drawn on evenly, the graft is held back by the wall of the tibia's tunnel, 0.5 N for each
// millimetre of tendon in it, and by the edge at the femur's mouth, about which the thread turns by
// 90 degrees: T = (tail + q s) exp(mu theta). What the hand pulls over that moves it on, and stays.
TEST(SessionPlacing, TheWallsOfTheTunnelsHoldTheGraftBackAsTheClosedForm) {
  const PlacingSession rig;
  const auto plan = find_placing(*felt_placing());
  ASSERT_TRUE(plan);
  Session session = rig.session();
  SessionState state = session.save();
  state.world.bones.placing.phase = PlacingPhase::kThreadOut;
  ASSERT_TRUE(session.restore(state));
  std::vector<double> pulls, drawn;
  for (std::uint64_t n = 1; n <= 5500; ++n) {
    const double t = static_cast<double>(n) * 0.001;
    HandInput hand;
    const double x = 0.070 + 0.012 * std::max(t - 1, 0.0);
    hand.input.X_WD = {Vec3(x, 0, 0), turn_between(Vec3::UnitZ(), Vec3(Vec3::UnitX()))};
    if (n == 1) hand.command = {CommandKind::kTake, 2};
    if (n == 300) hand.command = {CommandKind::kJaw, 1};
    if (n == 600) hand.command = {CommandKind::kJaw, 0};
    (void)session.tick(std::span(&hand, 1));
    if (n < 2000 || n % 500 != 0) continue;
    pulls.push_back(placed(session).pull_n);
    drawn.push_back(placed(session).drawn_m);
  }
  constexpr double kTail_n = 10, kDrag_n_per_m = 500, kThread = 0.2, kTurn_rad = 1.5707963;
  constexpr double kBeforeTendon_m = 0.020 + kFlipRoom_m;  // the loop, and what hangs before it
  ASSERT_EQ(plan->tail_n, kTail_n);
  double over_n = 0;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const double in_wall_m = std::max(0.0, drawn[i] - kBeforeTendon_m);
    const double form = (kTail_n + kDrag_n_per_m * in_wall_m) * std::exp(kThread * kTurn_rad);
    if (i == 0) over_n = pulls[i] - form;
    EXPECT_NEAR(pulls[i] - over_n, form, 0.01 * form) << drawn[i];
  }
  EXPECT_GT(over_n, 0);
  EXPECT_GT(pulls.back(), 2 * pulls.front()) << "the wall must be felt";
}

// A case without tunnels of its own, to which a graft is handed over.
struct OrderedSession {
  OrderedSession() {
    CaseDef def = testing::placing_def(true);
    const auto plan = find_placing(*felt_placing());
    numbers = placing_numbers(*plan);
    def.landmarks.clear();
    JointDef knee;
    knee.name = "flexion";
    knee.fixed = "femur";
    knee.at_deg = 90;
    PoseTrack track;
    track.first = 0;
    track.step = 30;
    const Pose rest = def.bones[0].X_WB.inverse() * def.bones[1].X_WB;
    for (int n = 0; n <= 4; ++n) {
      const Quat turn(Eigen::AngleAxisd(0.01 * (3 - n), Vec3::UnitY()));
      track.poses.push_back(Pose{Vec3::Zero(), turn} * rest);
    }
    knee.bones.push_back({"tibia", track});
    def.joints.push_back(knee);
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built) << (built ? "" : built.error().message());
    the_case = std::make_shared<const Case>(std::move(*built));
    recording.header = recording_header(*the_case, base.settings, "test", "0", base.tray);
  }
  Session session() const { return Session(the_case, base.settings, base.tray); }
  // Handed over from tick 11 on, one number every second tick; then the knee is bent.
  HandInput hand(std::uint64_t n) const {
    HandInput hand = pin_hand(n);
    hand.command = {};
    if (n == 10) hand.command = {CommandKind::kMark, 1};
    if (n == 12) hand.command = {CommandKind::kGraftOrder, 0};
    const std::uint64_t k = n / 2 - 7;
    if (n % 2 == 0 && n >= 14 && k < kPlacingNumbers)
      hand.command = {CommandKind::kGraftNumber, numbers[k]};
    if (n == 100) hand.command = {CommandKind::kBend, 60};
    if (n == 1400) hand.command = {CommandKind::kMark, 2};
    return hand;
  }
  void run(Session& session, std::uint64_t from, std::uint64_t to) const {
    for (std::uint64_t n = from; n <= to; ++n) {
      const HandInput one = hand(n);
      (void)session.tick(std::span(&one, 1));
    }
  }
  PlacingSession base;
  PlacingNumbers numbers{};
  std::shared_ptr<const Case> the_case;
  Recording recording;
};

TEST(SessionPlacing, AGraftThatIsHandedOverIsThereWithItsLastNumber) {
  const OrderedSession rig;
  Session session = rig.session();
  rig.run(session, 1, 46);
  EXPECT_FALSE(placed(session).on);
  rig.run(session, 47, 60);
  ASSERT_TRUE(placed(session).on);
  EXPECT_EQ(placing_numbers(placed(session).plan), rig.numbers);
  rig.run(session, 61, 1600);
  EXPECT_GT(placed(session).pin_m, 0.01);
  // Numbers that are no plan change nothing.
  Session other = rig.session();
  for (std::uint64_t n = 1; n <= 60; ++n) {
    HandInput one = rig.hand(n);
    if (n == 20) one.command.value = 1e9;
    (void)other.tick(std::span(&one, 1));
  }
  EXPECT_FALSE(placed(other).on);
  EXPECT_EQ(placed(other).told, 0u);
}

TEST(SessionPlacing, AnOrderedGraftAndABentKneeRepeatFromTheStartTheMiddleAndAMark) {
  OrderedSession rig;
  Session session = rig.session();
  for (std::uint64_t n = 1; n <= 1700; ++n) {
    HandInput one = rig.hand(n);
    if (n == 1600) one.command = {CommandKind::kRestore, 1};
    if (n == 1650) one.command = {CommandKind::kRestore, 2};
    (void)session.tick(std::span(&one, 1));
    rig.recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) rig.recording.steps.push_back(session.last_step_record());
    if (n == 1590) {
      EXPECT_TRUE(placed(session).on);
      EXPECT_NEAR(session.bones().bend.now_deg, 60, 1e-9);
      EXPECT_GT((session.bones().bones[1].X_WB.p - rig.the_case->bones[1].X_WB.p).norm(), 1e-4);
    }
    if (n == 1610) {
      EXPECT_FALSE(placed(session).on);
      EXPECT_FALSE(session.bones().bend.on);
      EXPECT_LT((session.bones().bones[1].X_WB.p - rig.the_case->bones[1].X_WB.p).norm(), 1e-12);
    }
    if (n == 1660) {
      EXPECT_TRUE(placed(session).on);
      EXPECT_NEAR(session.bones().bend.now_deg, 60, 1e-9);
    }
  }
  rig.recording.complete = true;
  ReplayOptions options;
  options.tray = rig.base.tray;
  const auto again = replay(rig.recording, rig.the_case, options);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
  for (const std::uint64_t stop : {30u, 300u, 1300u}) {
    Session one = rig.session();
    rig.run(one, 1, stop);
    Session two = rig.session();
    (void)go_on_as(two, one);
    rig.run(one, stop + 1, 1500);
    rig.run(two, stop + 1, 1500);
    EXPECT_EQ(two.state_hash(), one.state_hash()) << stop;
  }
}

}  // namespace
}  // namespace osteon
