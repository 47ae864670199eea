// The closed loop of an emulated hand and soft parts, with friction: pressed, they come to rest.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>

#include "osteon/device/virtual_hand.h"
#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "physics/disc_fixtures.h"
#include "session/driven_hand.h"
#include "session/skin_fixtures.h"
#include "session/soft_fixtures.h"
#include "session/soft_solid_fixtures.h"
#include "session/stump_fixtures.h"
#include "session/wound_fixtures.h"

namespace osteon {
namespace {

struct SoftLoop {
  double mass_kg, grip_n_s_per_m, stiffness_n_per_m;
};

std::vector<SoftLoop> soft_loops() {
  std::vector<SoftLoop> out;
  for (const double mass : {0.05, 0.15, 0.5})
    for (const double grip : {2.0, 12.0})
      for (const double k : {500.0, 2000.0, 3000.0}) out.push_back({mass, grip, k});
  return out;
}

std::shared_ptr<const SoftSetup> rough(const SoftSetup& smooth) {
  SoftSetup setup = smooth;
  add_friction(setup, {{0.12, 0.08}, {0.08, 0.05}});  // of the tissue table
  return std::make_shared<const SoftSetup>(std::move(setup));
}

constexpr double kSoftGrip_n_per_m = 500;

struct SoftOutcome {
  std::vector<double> window_energy;  // largest of each quarter second, J
  double last_swing_m = 0, last_force_n = 0;
};

/// Where a hand was in each tick.
struct SoftSwing {
  std::vector<Vec3> place, speed;

  void add(const VirtualHand& hand) {
    place.push_back(hand.pose().p);
    speed.push_back(hand.velocity());
  }
  SoftOutcome outcome(const SoftLoop& loop, const Vec3& last_force_W) const {
    SoftOutcome out;
    out.last_force_n = last_force_W.norm();
    for (std::size_t begin = 500; begin + 250 <= place.size(); begin += 250) {
      double largest = 0;
      out.last_swing_m = 0;
      for (std::size_t i = begin; i < begin + 250; ++i) {
        const double swing = (place[i] - place.back()).norm();
        largest = std::max(largest, 0.5 * loop.mass_kg * speed[i].squaredNorm() +
                                        0.5 * kSoftGrip_n_per_m * swing * swing);
        out.last_swing_m = std::max(out.last_swing_m, swing);
      }
      out.window_energy.push_back(largest);
    }
    return out;
  }
};

// From `from` at that speed to `to`, which the hand then aims at; the force comes a tick late.
SoftOutcome press_softly(Session& session, const SoftLoop& loop, const ToolInput& from,
                         const Vec3& to_W, double speed_m_per_s = 0.05, int ticks = 2500) {
  VirtualHand hand({loop.mass_kg, kSoftGrip_n_per_m, loop.grip_n_s_per_m});
  Pose wanted = from.X_WD;
  hand.reset(wanted);
  const Vec3 way = to_W - from.X_WD.p;
  const int moves = static_cast<int>(way.norm() / speed_m_per_s / 1e-3);
  Vec3 late = Vec3::Zero();
  SoftSwing swing;
  for (int i = 0; i < ticks; ++i) {
    wanted.p = from.X_WD.p + std::min(1.0, static_cast<double>(i) / moves) * way;
    const Vec3 wanted_v = i < moves ? Vec3(speed_m_per_s * way.normalized()) : Vec3(Vec3::Zero());
    ToolInput input;
    input.X_WD = hand.pose();
    input.v_W = hand.velocity();
    (void)session.tick(input);
    hand.step(1e-3, wanted, wanted_v, late);
    late = session.tool_state().force_W;
    swing.add(hand);
  }
  return swing.outcome(loop, late);
}

void expect_rest(const SoftOutcome& o, const SoftLoop& loop, double least_n = 0.5) {
  SCOPED_TRACE("mass " + std::to_string(loop.mass_kg) + " grip " +
               std::to_string(loop.grip_n_s_per_m) + " k " +
               std::to_string(loop.stiffness_n_per_m));
  constexpr double kNothing = 1e-13;  // J
  for (std::size_t i = 1; i < o.window_energy.size(); ++i)
    EXPECT_LE(o.window_energy[i], 0.85 * o.window_energy[i - 1] + kNothing) << "window " << i;
  EXPECT_LT(o.last_swing_m, 3e-5);
  EXPECT_GT(o.last_force_n, least_n) << "it must be pressed";
}

TEST(SoftStability, AMeniscusPressedOrLiftedComesToRest) {
  const testing::MeniscusRun& run = testing::meniscus_run();
  const auto softs = rough(*run.softs);
  for (const double side : {1.0, -1.0})
    for (const SoftLoop& loop : soft_loops()) {
      SessionSettings settings = run.settings;
      settings.soft_hash = softs->hash;
      settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
      Session session(run.the_case, settings, run.tray, nullptr, softs);
      ToolInput from;
      from.X_WD.p = {0.002, 0, side * (testing::kBlockTop_m + 0.004)};
      expect_rest(
          press_softly(session, loop, from, {0.002, 0, side * (testing::kBlockTop_m - 0.006)}),
          loop);
    }
}

TEST(SoftStability, ALigamentTautOrSlackComesToRest) {
  for (const double strain : {0.05, -0.01}) {
    testing::BandRun run(testing::band_table(strain));
    run.softs = rough(*run.softs);
    run.settings.soft_hash = run.softs->hash;
    for (const SoftLoop& loop : soft_loops()) {
      run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
      Session session = run.session();
      const ToolInput from = testing::shaft_at(testing::kTouch_m + 0.004);
      const Vec3 to_W = testing::shaft_at(testing::kTouch_m - 0.009).X_WD.p;
      expect_rest(press_softly(session, loop, from, to_W), loop);
    }
  }
}

// As short, thin and stiff as the dorsal scapholunate one.
// Its surface is stiffer than that of the whole, and its pull a ninth. Pressed from below, where
// its strands are.
TEST(SoftStability, WhatIsLeftOfACutLigamentComesToRest) {
  testing::BandRun run;
  SoftSetup setup = *rough(*run.softs);
  let_bands_part_by_strands(setup);
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  run.settings.soft_hash = run.softs->hash;
  for (const SoftLoop& loop : soft_loops()) {
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    Session session = run.session();
    SessionState state = session.save();
    std::uint64_t& gone = state.world.softs.bands[0].gone;
    const StrandAxes axes{Vec3::UnitX(), Vec3::UnitZ()};
    for (int i = 0; i < 54; ++i)
      gone |= std::uint64_t{1} << strand_under(gone, axes, Vec3::UnitZ());
    ASSERT_TRUE(session.restore(state));
    expect_rest(press_softly(session, loop, testing::shaft_at(-testing::kTouch_m - 0.004),
                             testing::shaft_at(-testing::kTouch_m + 0.009).X_WD.p),
                loop);
    EXPECT_EQ(strands_left(session.softs()->state().bands[0].gone), 7.0 / kStrands);
  }
}

TEST(SoftStability, ALigamentOfAWristComesToRest) {
  constexpr double kShort_m = 0.0065;
  testing::BandRun run;
  SoftSetup setup = *rough(*run.softs);
  SoftBand& band = setup.bands.front();
  const double less_m = (testing::kBandGap_m - kShort_m) / 2;
  band.from_B.x() += less_m;
  band.to_B.x() -= less_m;
  band.radius_m = 0.0014;
  band.fibres = {{kShort_m / 1.03, 360, 0.03}};
  setup.hash = hash_of(setup.bands);
  run.softs = std::make_shared<const SoftSetup>(setup);
  run.settings.soft_hash = setup.hash;
  for (const SoftLoop& loop : soft_loops()) {
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    Session session = run.session();
    const ToolInput from = testing::shaft_at(testing::kTouch_m + 0.004);
    expect_rest(press_softly(session, loop, from, testing::shaft_at(-0.003).X_WD.p), loop);
  }
}

TEST(SoftStability, ADiscPressedOrLiftedWholeOrTornComesToRest) {
  for (const bool torn : {false, true}) {
    testing::MeniscusRun run(testing::meniscus_case());
    run.the_case = testing::disc_case(torn);
    auto made = make_disc_solids(*run.the_case, testing::disc_row(), testing::kDiscTable_n_per_m);
    ASSERT_TRUE(made) << made.error().message();
    SoftSetup setup;
    add_solids(setup, std::move(*made));
    run.settings.soft = {"tfcc"};
    run.softs = rough(setup);
    run.settings.soft_hash = run.softs->hash;
    const double touch_m = testing::kDiscThick_m / 2 + testing::kBallRadius_m;
    for (const double side : {1.0, -1.0})
      for (const SoftLoop& loop : soft_loops()) {
        run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
        Session session = run.session();
        ToolInput from;
        from.X_WD.p = {0.001, 0.001, side * (touch_m + 0.003)};
        const Vec3 to_W(0.001, 0.001, side * (touch_m - 0.006));
        // A heavy hand that is held loosely swings longer on it than on a meniscus.
        expect_rest(press_softly(session, loop, from, to_W, 0.05, 3500), loop, 0.2);
      }
  }
}

struct SkinWay {
  double tendon_m;  // under the skin's top, where x is negative
  double from_x, to_x;
};

testing::SkinRun rough_skin(double limb_m, double tendon_m) {
  testing::SkinRun run(limb_m, false, tendon_m);
  SoftSetup setup = *run.softs;
  add_friction(setup, {{}, {}, {0.4, 0.3}});  // of the tissue table
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  return run;
}

// A loose hand that slides over skin, or is pressed aside on a limb, shakes by 0.2 mm under a
// coupling of 3000 N/m, over fat alone as well: the damper of its friction fades where it slips.
// There the coupling is 2000 at most.
void expect_skin_rests(const SkinWay& way, double most_n_per_m) {
  for (const double limb_m : {0.0, 0.060}) {
    testing::SkinRun run = rough_skin(limb_m, way.tendon_m);
    for (const SoftLoop& loop : soft_loops()) {
      if (loop.stiffness_n_per_m > (limb_m > 0 ? 2000 : most_n_per_m)) continue;
      SCOPED_TRACE("limb " + std::to_string(limb_m) + ", tendon at " +
                   std::to_string(way.tendon_m) + ", from " + std::to_string(way.from_x) + " to " +
                   std::to_string(way.to_x));
      run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
      Session session = run.session();
      ToolInput from;
      from.X_WD.p = {way.from_x, 0.001, 0.004};
      // Over a tendon the skin is as stiff as the coupling: there a heavy hand that is held loosely
      // swings longer.
      const bool long_swing = loop.mass_kg > 0.3 && loop.grip_n_s_per_m < 5;
      expect_rest(press_softly(session, loop, from, {way.to_x, 0.001, -0.008}, 0.05,
                               long_swing ? 8500 : 2500),
                  loop);
    }
  }
}

// Over the middle of a tendon and on its edge, beside which the push rises.
TEST(SoftStability, SkinPressedOverATendonComesToRest) {
  for (const SkinWay& way : {SkinWay{0.003, -0.008, -0.008}, SkinWay{0.003, 0, 0}})
    expect_skin_rests(way, 3000);
}

TEST(SoftStability, SkinSlidOverATendonsEdgeComesToRest) {
  for (const SkinWay& way : {SkinWay{0.003, -0.004, 0.004}, SkinWay{0.003, 0.004, 0}})
    expect_skin_rests(way, 2000);
}

/// One that moves from where it is to where it aims at, in 0.15 s.
struct WoundHand {
  WoundHand(const SoftLoop& loop, const Vec3& begin_W, const Vec3& end_W)
      : from_W(begin_W), to_W(end_W), hand({loop.mass_kg, kSoftGrip_n_per_m, loop.grip_n_s_per_m}) {
    hand.reset({from_W, Quat::Identity()});
  }
  HandInput input() const {
    HandInput in;
    in.input.X_WD = hand.pose();
    in.input.v_W = hand.velocity();
    return in;
  }
  void step(int tick, const Vec3& force_W) {
    constexpr int kMoves = 150;
    const Vec3 way = to_W - from_W;
    const Pose wanted{from_W + std::min(1.0, static_cast<double>(tick) / kMoves) * way,
                      Quat::Identity()};
    hand.step(1e-3, wanted, tick < kMoves ? Vec3(way / (1e-3 * kMoves)) : Vec3(Vec3::Zero()), late);
    late = force_W;
    swing.add(hand);
  }
  Vec3 from_W, to_W, late = Vec3::Zero();
  VirtualHand hand;
  SoftSwing swing;
};

// Both hands are emulated: the right one draws a lip aside with a retractor, the left one has a
// shaft between the lips and presses the other lip, or stays clear of both.
void expect_wound_rests(const SessionState& in_wound, const Vec3& left_to_W, double left_least_n) {
  for (const SoftLoop& loop : soft_loops()) {
    testing::WoundRun run = testing::wound_run();
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    Session session = run.session();
    ASSERT_TRUE(session.restore(in_wound));
    const auto at = [&](std::size_t hand) { return session.tool_state(hand).X_WP.p; };
    WoundHand right(loop, at(0), at(0) + Vec3(0, 0.005, 0)), left(loop, at(1), left_to_W);
    for (int i = 0; i < 3000; ++i) {
      const std::array<HandInput, 2> in = {right.input(), left.input()};
      (void)session.tick(in);
      right.step(i, session.tool_state(0).force_W);
      left.step(i, session.tool_state(1).force_W);
    }
    expect_rest(right.swing.outcome(loop, right.late), loop);
    expect_rest(left.swing.outcome(loop, left.late), loop, left_least_n);
    EXPECT_GT(session.softs()->pushes().lip_count, 2u) << "the wound must be held open";
  }
}

TEST(SoftStability, HandsInAWoundThatOneHoldsOpenComeToRest) {
  Session session = testing::wound_run().session();
  testing::TwoInSkin hands(session);
  hands.cut();
  hands.take(1, testing::kSkinScope);
  hands.set_in();
  hands.move(0, {0, 0.005, -testing::kDeep_m}, 400);
  hands.move(1, {0, 0.001, 0.010}, 200);
  hands.move(1, {0, 0.001, -0.010}, 400);
  hands.rest(50);
  const SessionState in_wound = session.save();
  expect_wound_rests(in_wound, {0, 0.001, -0.010}, -1);
  expect_wound_rests(in_wound, {0, -0.006, -0.010}, 0.5);
}

// It is the last in the tray.
template <class Run>
void add_gripper(Run& run, const char* name) {
  const auto instruments = load_instruments();
  ASSERT_TRUE(instruments);
  const Instrument* gripper = find_instrument(*instruments, name);
  run.settings.tray.emplace_back(name);
  run.tray.push_back(std::make_shared<const Tool>(make_tool(*gripper, gripper->usual_size)));
  auto grippers = make_soft_grippers(run.settings.tray);
  ASSERT_TRUE(grippers);
  SoftSetup setup = *run.softs;
  add_grippers(setup, std::move(*grippers));
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
}

// Open about it, shut, and then drawn aside by a hand that is held loosely or firmly.
void expect_rest_of_held(Session session, const SoftLoop& loop, const ToolInput& at,
                         const Vec3& by_W, std::uint32_t grasper) {
  (void)session.tick(at, {CommandKind::kTake, static_cast<double>(grasper)});
  (void)session.tick(at, {CommandKind::kJaw, 1});
  for (int n = 0; n < 50; ++n) (void)session.tick(at);
  (void)session.tick(at, {CommandKind::kJaw, 0});
  for (int n = 0; n < 50; ++n) (void)session.tick(at);
  expect_rest(press_softly(session, loop, at, at.X_WD.p + by_W), loop);
  EXPECT_NE(session.softs()->state().grips[0].hold.of, SoftHold::Of::kNothing);
}

TEST(SoftStability, AHeldLigamentDrawnAsideComesToRest) {
  for (const double strain : {0.05, -0.01}) {
    testing::BandRun run(testing::band_table(strain));
    add_gripper(run, "grasper");
    for (const SoftLoop& loop : soft_loops()) {
      run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
      ToolInput at;
      at.X_WD.p = testing::kBandMiddle + Vec3(0, 0, -0.004);
      expect_rest_of_held(run.session(), loop, at, {0, 0, 0.009}, 1);
    }
  }
}

TEST(SoftStability, AHeldMeniscusLiftedComesToRest) {
  testing::MeniscusRun run = testing::meniscus_run();
  add_gripper(run, "grasper");
  for (const SoftLoop& loop : soft_loops()) {
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    ToolInput at;
    at.X_WD.p = {0.006, 0, 0};
    at.X_WD.q = Quat((Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished());  // z to +x, y to +z
    expect_rest_of_held(run.session(), loop, at, {0, 0, 0.009}, 1);
  }
}

// The stump's fixture, with friction, and a ball that is the last in the tray.
testing::StumpRun rough_stump() {
  testing::StumpRun run = testing::stump_run();
  Tool ball;
  ball.name = "ball";
  ball.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), testing::kBallRadius_m));
  run.tray.push_back(std::make_shared<const Tool>(ball));
  run.settings.tray.emplace_back("ball");
  run.softs = rough(*run.softs);
  run.settings.soft_hash = run.softs->hash;
  return run;
}

// Of two plunges of a drill on each side a wall about 2 mm thick is left, which bends.
SessionState drilled_to_a_wall(const testing::StumpRun& run) {
  Session session = run.session();
  testing::DrivenHand hand(session, {0, 0, 0.018}, testing::posed(Vec3::UnitY(), Vec3::UnitZ()));
  hand.take(4);
  hand.tick({CommandKind::kPower, 1});
  for (const double x : {-0.00505, 0.00505})
    for (const double y : {-0.0035, 0.0, 0.0035}) {
      hand.move({x, y, 0.014}, 60);
      hand.move({x, y, 0.004}, 700);
      hand.move({x, y, 0.014}, 60);
    }
  hand.tick({CommandKind::kPower, 0});
  hand.rest(1000);
  EXPECT_GT(session.softs()->removed_m3(0), 100e-9);
  return session.save();
}

struct StumpPress {
  Vec3 from_W, to_W;
  double least_n;
};

// Sessions are kept, by the coupling: the stiffness of what was cut takes a while to restore.
void expect_stump_rests(testing::StumpRun run, const SessionState& state,
                        std::span<const StumpPress> presses) {
  const auto ball = static_cast<double>(run.tray.size() - 1);
  std::map<double, std::unique_ptr<Session>> sessions;
  for (const StumpPress& press : presses)
    for (const SoftLoop& loop : soft_loops()) {
      run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
      auto& kept = sessions[loop.stiffness_n_per_m];
      if (!kept) kept = std::make_unique<Session>(run.session());
      Session& session = *kept;
      ASSERT_TRUE(session.restore(state));
      ToolInput from;
      from.X_WD.p = press.from_W;
      (void)session.tick(from, {CommandKind::kTake, ball});
      for (int n = 0; n < 20; ++n) (void)session.tick(from);
      SCOPED_TRACE("from " + std::to_string(press.from_W.x()) + " " +
                   std::to_string(press.from_W.z()));
      expect_rest(press_softly(session, loop, from, press.to_W), loop, press.least_n);
    }
}

// From above, from the side at half of its height, and of what a drill has left from both.
TEST(SoftStability, AStumpPressedFromAboveOrBesideComesToRest) {
  const testing::StumpRun run = rough_stump();
  const double top = 2 * testing::kStumpHalf.z(), side = testing::kStumpHalf.x();
  const std::array<StumpPress, 2> presses = {
      StumpPress{{0.001, 0, top + 0.004}, {0.001, 0, top - 0.004}, 0.5},
      StumpPress{{side + 0.005, 0.001, 0.008}, {side - 0.004, 0.001, 0.008}, 0.5}};
  expect_stump_rests(run, run.session().save(), presses);
}

TEST(SoftStability, WhatADrillHasLeftOfAStumpComesToRest) {
  const testing::StumpRun run = rough_stump();
  const double top = 2 * testing::kStumpHalf.z();
  const std::array<StumpPress, 2> presses = {
      StumpPress{{0, 0, top + 0.004}, {0, 0, top - 0.004}, 0.2},
      StumpPress{{0.007, 0.001, 0.009}, {-0.002, 0.001, 0.009}, 0.02}};
  expect_stump_rests(run, drilled_to_a_wall(run), presses);
}

TEST(SoftStability, AHeldStumpDrawnAsideComesToRest) {
  testing::StumpRun run = rough_stump();
  add_gripper(run, "grasper");
  const auto grasper = static_cast<std::uint32_t>(run.tray.size() - 1);
  for (const SoftLoop& loop : soft_loops()) {
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    ToolInput at;
    at.X_WD.p = {0.003, 0, 0.009};
    at.X_WD.q = Quat((Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished());  // z to +x, y to +z
    expect_rest_of_held(run.session(), loop, at, {0.006, 0, 0.003}, grasper);
  }
}

// Suction under full power at `from`, drawn away by a hand to `off`, where it still holds, or
// farther than it can: in 0.4 s, so that its own swing does not pull it off.
template <class Run>
void expect_rest_under_suction(Run run, const Vec3& surface_W) {
  add_gripper(run, "suction");
  const std::size_t last = run.tray.size() - 1;
  const double mouth_m = run.softs->grippers[last]->bore_T.z();
  const double full_n = suction_at(*run.softs->grippers[last], 0);
  const auto over = [&](double gap_m) { return Vec3(surface_W + Vec3(0, 0, gap_m - mouth_m)); };
  for (const SoftLoop& loop : soft_loops()) {
    run.settings.haptic.stiffness_n_per_m = loop.stiffness_n_per_m;
    for (const double gap_m : {0.0002, 0.006}) {
      Session session = run.session();
      ToolInput at;
      at.X_WD.p = over(0.00001);
      (void)session.tick(at, {CommandKind::kTake, static_cast<double>(last)});
      for (int n = 0; n < 50; ++n) (void)session.tick(at);
      (void)session.tick(at, {CommandKind::kPower, 1});
      for (int n = 0; n < 50; ++n) (void)session.tick(at);
      ASSERT_NE(session.softs()->state().grips[0].hold.of, SoftHold::Of::kNothing);
      const bool holds = gap_m < 0.001;
      const SoftOutcome o = press_softly(session, loop, at, over(gap_m), gap_m / 0.4);
      expect_rest(o, loop, holds ? 0.05 * full_n : -1);
      EXPECT_EQ(session.softs()->state().grips[0].hold.of != SoftHold::Of::kNothing, holds);
      EXPECT_LE(o.last_force_n, full_n + 1e-9);
    }
  }
}

TEST(SoftStability, ALigamentUnderSuctionComesToRest) {
  expect_rest_under_suction(testing::BandRun(testing::band_table(0.01)),
                            testing::kBandMiddle + Vec3(0, 0, testing::kBandRadius_m));
}

TEST(SoftStability, AStumpUnderSuctionComesToRest) {
  expect_rest_under_suction(rough_stump(), Vec3(0.001, 0.001, 2 * testing::kStumpHalf.z()));
}

TEST(SoftStability, AMeniscusUnderSuctionComesToRest) {
  expect_rest_under_suction(testing::meniscus_run(),
                            Vec3(0.002, 0.001, testing::kMeniscusHalf.z()));
}

}  // namespace
}  // namespace osteon
