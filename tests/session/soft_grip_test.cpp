// Jaws that hold what is soft in a session: the shipped grasper, clamp and punch.
#include <gtest/gtest.h>

#include <cmath>

#include "count_allocations.h"
#include "driven_hand.h"
#include "osteon/base/random.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_fixtures.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::allocations;
using testing::band_table;
using testing::BandRun;
using testing::begin_recording;
using testing::DrivenHand;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::kBandGap_m;
using testing::kBandMiddle;
using testing::kBandStiffness_n;
using testing::kBandStrain;
using testing::kBandToe;

enum : std::uint32_t { kFirst, kGrasper, kClamp, kGripPunch };
constexpr double kGrasperHolds_n = 10;
constexpr double kInMouth_m = 0.004;  // from the tip to what is held

template <class Run>
void add_jaws(Run& run) {
  const auto instruments = load_instruments();
  ASSERT_TRUE(instruments);
  for (const char* name : {"grasper", "clamp", "basket_punch"}) {
    const Instrument* found = find_instrument(*instruments, name);
    run.settings.tray.emplace_back(name);
    run.tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
  }
  SoftSetup setup = *run.softs;
  auto cutters = make_solid_cutters(run.settings.tray);
  ASSERT_TRUE(cutters);
  add_cutters(setup, std::move(*cutters), 6);
  auto grippers = make_soft_grippers(run.settings.tray);
  ASSERT_TRUE(grippers) << grippers.error().message();
  EXPECT_FALSE((*grippers)[kFirst]);
  add_grippers(setup, std::move(*grippers));
  EXPECT_NE(setup.hash, run.softs->hash);
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
}

BandRun band_run(const LigamentTable& table = band_table()) {
  BandRun run(table);
  add_jaws(run);
  return run;
}

const testing::MeniscusRun& meniscus_run() {
  static const testing::MeniscusRun run = [] {
    testing::MeniscusRun made;
    add_jaws(made);
    return made;
  }();
  return run;
}

struct JawHand : DrivenHand {
  explicit JawHand(Session& s) : DrivenHand(s, kBandMiddle + Vec3(0, 0, 0.020)) {
    store_every = 250;
  }

  void take(std::uint32_t instrument) {
    DrivenHand::take(instrument);
    rest(40);
  }
  void jaws(double open) { tick({CommandKind::kJaw, open}); }
  // The band between its open jaws, which then shut.
  void hold_band(std::uint32_t instrument = kGrasper, double aside_m = 0) {
    take(instrument);
    jaws(1);
    move(kBandMiddle + Vec3(0, aside_m, -kInMouth_m), 200);
    jaws(0);
    rest(20);
  }
  Event first(EventKind kind) const {
    const auto found = std::find_if(events.begin(), events.end(),
                                    [kind](const Event& event) { return event.kind == kind; });
    return found == events.end() ? Event{} : *found;
  }
  const SoftGrip& grip() const { return session.softs()->state().grips[0]; }
  bool holds() const { return grip().hold.of != SoftHold::Of::kNothing; }
};

TEST(SoftGrip, OpenJawsPressNothingAndShutAboutNothingHoldNothing) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.take(kGrasper);
  hand.jaws(1);
  hand.move(kBandMiddle + Vec3(0, 0, -kInMouth_m), 200);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  hand.move(kBandMiddle + Vec3(0, 0, 0.010), 200);
  hand.jaws(0);
  hand.rest(20);
  EXPECT_FALSE(hand.holds());
  // Jaws that were shut all the time press it, and do not take it.
  hand.move(kBandMiddle + Vec3(0, 0, 0.001), 200);
  EXPECT_GT(session.tool_state().force_W.z(), 0.5);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(hand.count(kSoftHeld), 0u);
}

// Two straight legs to the jaws, tension T = k (strain - toe): they pull with 2 T b / l. What the
// hand is further than the string is in the jaws.
TEST(SoftGrip, AHeldLigamentPullsAsTwoLegs) {
  const BandRun run = band_run();
  for (const double pulled : {0.001, 0.003, -0.004}) {
    Session session = run.session();
    JawHand hand(session);
    hand.hold_band();
    ASSERT_TRUE(hand.holds());
    ASSERT_EQ(hand.count(kSoftHeld), 1u);
    EXPECT_EQ(hand.first(kSoftHeld).values[0], kGrasperHolds_n);
    EXPECT_EQ(run.the_case->softs[hand.first(kSoftHeld).subject].name, "acl");
    EXPECT_LT((hand.first(kSoftHeld).p_W - kBandMiddle).norm(), 1e-6);
    EXPECT_LT(session.tool_state().force_W.norm(), 0.01);
    hand.move(hand.at + Vec3(0, 0, pulled), 200);
    hand.rest(200);
    const double force = -session.tool_state().force_W.z();
    const double bent = pulled - force / kJawSpring_n_per_m;
    const double leg = std::hypot(kBandGap_m / 2, bent), slack = kBandGap_m / (1 + kBandStrain);
    const double tension = kBandStiffness_n * (2 * leg / slack - 1 - kBandToe);
    EXPECT_NEAR(force, 2 * tension * bent / leg, 0.01 * std::abs(force));
    EXPECT_NEAR(session.softs()->readout(0).force_n[0], std::abs(force), 0.01 * std::abs(force));
    EXPECT_NEAR(session.softs()->readout(0).tension_n, tension, 0.01 * tension);
  }
}

// Beside the middle of the mouth: the jaws draw it between them as they shut, without a step.
TEST(SoftGrip, ShuttingJawsDrawTheLigamentBetweenThem) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.take(kGrasper);
  hand.jaws(1);
  hand.move(kBandMiddle + Vec3(0, 0.003, -kInMouth_m), 200);
  hand.jaws(0);
  double last = 0, most = 0;
  for (int n = 0; n < 300; ++n) {
    hand.tick();
    const double force = session.tool_state().force_W.norm();
    most = std::max(most, std::abs(force - last));
    last = force;
  }
  ASSERT_TRUE(hand.holds());
  EXPECT_LT(session.tool_state().force_W.y(), -2);
  EXPECT_LT(most, 0.3);
  EXPECT_NEAR(hand.grip().hold.p_T.y(), 0, 1e-9);
}

TEST(SoftGrip, PulledTooHardItSlipsOutAndIsTakenAgainAfterOpening) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.hold_band();
  hand.move(hand.at + Vec3(0, 0, 0.014), 700);
  ASSERT_EQ(hand.count(kSoftSlipped), 1u);
  const Event slipped = hand.first(kSoftSlipped);
  EXPECT_EQ(run.the_case->softs[slipped.subject].name, "acl");
  EXPECT_GT(slipped.values[0], kGrasperHolds_n);
  EXPECT_LT(slipped.values[0], 1.05 * kGrasperHolds_n);
  EXPECT_EQ(slipped.values[1], kGrasperHolds_n);
  EXPECT_NEAR(slipped.values[2], 1e3 * (slipped.p_W - kBandMiddle).norm(), 0.01);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  EXPECT_FALSE(session.softs()->state().bands[0].torn);
  hand.move(kBandMiddle + Vec3(0, 0, -kInMouth_m), 300);
  EXPECT_FALSE(hand.holds());
  hand.jaws(1);
  hand.rest(10);
  hand.jaws(0);
  hand.rest(10);
  EXPECT_TRUE(hand.holds());
  EXPECT_EQ(hand.count(kSoftHeld), 2u);
}

TEST(SoftGrip, OpenedJawsLetGoAndSayHowHardTheyPulled) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.hold_band();
  hand.move(hand.at + Vec3(0, 0, 0.003), 200);
  hand.rest(100);
  const double force = session.softs()->readout(0).force_n[0];
  hand.jaws(1);
  hand.rest(10);
  ASSERT_EQ(hand.count(kSoftFreed), 1u);
  EXPECT_NEAR(hand.first(kSoftFreed).values[0], 0.32, 0.01);
  EXPECT_NEAR(hand.first(kSoftFreed).values[1], force, 0.01 * force);
  EXPECT_NEAR(hand.first(kSoftFreed).values[2], 3, 0.01);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  // Whoever takes another instrument lets go, too.
  hand.jaws(0);
  hand.rest(10);
  ASSERT_TRUE(hand.holds());
  hand.take(kFirst);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(hand.count(kSoftFreed), 2u);
}

TEST(SoftGrip, AWeakLigamentTearsBeforeTheJawsSlipAndAMarkMakesItWhole) {
  const BandRun run = band_run(band_table(0.004, 35));
  Session session = run.session();
  JawHand hand(session);
  hand.tick({CommandKind::kMark, 0});
  hand.hold_band();
  hand.move(hand.at + Vec3(0, 0, 0.014), 700);
  ASSERT_EQ(hand.count(kSoftTorn), 1u);
  EXPECT_EQ(hand.count(kSoftSlipped), 0u);
  const Event torn = hand.first(kSoftTorn);
  EXPECT_EQ(run.the_case->softs[torn.subject].name, "acl");
  EXPECT_EQ(torn.hand, 0);
  EXPECT_GT(torn.values[0], 35);
  EXPECT_LT(torn.values[0], 37);
  // F = 2 T b / l at T = 35 N.
  const double l = (35 / kBandStiffness_n + 1 + kBandToe) * kBandGap_m / 1.004 / 2;
  const double b = std::sqrt(l * l - kBandGap_m * kBandGap_m / 4);
  EXPECT_NEAR(torn.values[1], 2 * 35 * b / l, 0.05 * torn.values[1]);
  EXPECT_NEAR(session.softs()->state().bands[0].torn_share, 0.5, 1e-6);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(100);
  EXPECT_FALSE(session.softs()->state().bands[0].torn);
  EXPECT_FALSE(hand.holds());
  hand.hold_band();
  EXPECT_TRUE(hand.holds());
}

TEST(SoftGrip, ARestorePointMadeWhileItWasHeldIsComeBackToWithEmptyJaws) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.hold_band();
  ASSERT_TRUE(hand.holds());
  hand.tick({CommandKind::kMark, 0});
  hand.move(hand.at + Vec3(0, 0, 0.002), 100);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(200);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

// Of a size and kind of its own: what it holds is its file's.
TEST(SoftGrip, APunchHoldsALigamentLessHardAndAClampHarder) {
  for (const auto& [instrument, holds_n] : {std::pair{kGripPunch, 6.0}, std::pair{kClamp, 20.0}}) {
    const BandRun run = band_run();
    Session session = run.session();
    JawHand hand(session);
    hand.hold_band(instrument, instrument == kGripPunch ? -0.002 : 0);
    ASSERT_TRUE(hand.holds()) << instrument;
    hand.move(hand.at + Vec3(0, 0, 0.028), 1100);
    ASSERT_EQ(hand.count(kSoftSlipped), 1u);
    EXPECT_GT(hand.first(kSoftSlipped).values[0], holds_n);
    EXPECT_LT(hand.first(kSoftSlipped).values[0], 1.05 * holds_n + 0.1);
  }
}

TEST(SoftGrip, AStepWithHeldJawsAllocatesNothing) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.hold_band();
  ASSERT_TRUE(hand.holds());
  ToolInput input;
  for (int n = 0; n < 100; ++n) {
    input.X_WD = {hand.at + Vec3(0, 0, 2e-5 * n), hand.q};
    const std::uint64_t before = allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones());
    if (n % 2 == 0) (void)session.physics_step(tool);
    ASSERT_EQ(allocations(), before) << n;
  }
  EXPECT_TRUE(hand.holds());
}

// The punch and the grasper come from +x, as far as 8 mm over the end of the block.
void reach_block(JawHand& hand, std::uint32_t instrument) {
  const Vec3 y_W(0, 0, 1), z_W(1, 0, 0);
  hand.q = Quat((Mat3() << y_W.cross(z_W), y_W, z_W).finished());
  const double up = instrument == kGripPunch ? -0.0033 : 0;
  hand.at = {0.030, 0, up};
  hand.take(instrument);
  hand.jaws(1);
  hand.move({0.006, 0, up}, 300);
  hand.jaws(0);
  hand.rest(150);
}

// The solid and the jaws, one behind the other: 450 to 900 N/m (lifted or lying) and 1000.
TEST(SoftGrip, AHeldMeniscusPullsBackAsStiffAsItIsAndSlips) {
  Session session = meniscus_run().session();
  JawHand hand(session);
  reach_block(hand, kGrasper);
  ASSERT_TRUE(hand.holds());
  ASSERT_EQ(hand.count(kSoftHeld), 1u);
  EXPECT_EQ(meniscus_run().the_case->softs[hand.first(kSoftHeld).subject].name, "medial_meniscus");
  EXPECT_LT(session.tool_state().force_W.norm(), 0.1);
  EXPECT_LT(std::abs(hand.first(kSoftHeld).p_W.z()), 0.001);
  for (const double lift : {0.004, 0.008}) {
    hand.move({0.006, 0, lift}, 200);
    hand.rest(300);
    const double k = -session.tool_state().force_W.z() / lift;
    EXPECT_GT(k, 1 / (2.05 / testing::kMeniscus_n_per_m + 1 / kJawSpring_n_per_m));
    EXPECT_LT(k, 1 / (0.95 / testing::kMeniscus_n_per_m + 1 / kJawSpring_n_per_m));
    EXPECT_NEAR(session.softs()->solid_readout(0).force_n[0], k * lift, 0.02 * k * lift);
  }
  // It is drawn as it is held: a push against the way of the pull.
  const SoftPushes pushes = session.softs()->pushes();
  ASSERT_EQ(pushes.count, 1u);
  EXPECT_LT(pushes.all[0].nhat_B.z(), -0.95);
  EXPECT_GT(pushes.all[0].force_n, 2);
  EXPECT_FALSE(session.softs()->is_asleep(0));
  hand.move({0.006, 0, 0.030}, 500);
  ASSERT_EQ(hand.count(kSoftSlipped), 1u);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

TEST(SoftGrip, APunchBitesAMeniscusAndDoesNotHoldIt) {
  Session session = meniscus_run().session();
  JawHand hand(session);
  reach_block(hand, kGripPunch);
  EXPECT_FALSE(hand.holds());
  EXPECT_GT(session.softs()->removed_m3(0), 20e-9);
}

// What another punch has bitten out while the jaws held it: they have that piece, and no more.
TEST(SoftGrip, WhatIsCutOffBetweenTheJawsLeavesTheRestFree) {
  Session bitten = meniscus_run().session();
  JawHand punch(bitten);
  reach_block(punch, kGripPunch);
  Session session = meniscus_run().session();
  JawHand hand(session);
  reach_block(hand, kGrasper);
  ASSERT_TRUE(hand.holds());
  hand.move(hand.at + Vec3(0, 0, 0.004), 200);
  hand.rest(100);
  EXPECT_LT(session.tool_state().force_W.z(), -1);
  SessionState state = session.save();
  state.world.softs.cut = bitten.save().world.softs.cut;
  ASSERT_TRUE(state.world.softs.cut);
  ASSERT_TRUE(session.restore(state));
  ASSERT_TRUE(hand.holds());
  hand.rest(10);
  EXPECT_FALSE(hand.holds());
  ASSERT_EQ(hand.count(kSoftFreed), 1u);
  EXPECT_GT(hand.first(kSoftFreed).values[1], 1);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  EXPECT_EQ(session.softs()->solid_readout(0).force_n[0], 0);
}

void wander(JawHand& hand, Random& random, int turns) {
  for (int n = 0; n < turns; ++n) {
    hand.jaws(random.uniform(0, 1) < 0.5 ? 1 : 0);
    Vec3 to = kBandMiddle + Vec3(0, 0, -kInMouth_m);
    to += Vec3(random.uniform(-0.01, 0.01), random.uniform(-0.004, 0.004),
               random.uniform(-0.006, 0.014));
    hand.move(to, 60);
  }
}

TEST(SoftGrip, AReplayIsTheSameFromTheStartAndFromTheMiddle) {
  const BandRun run = band_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  JawHand hand(session);
  hand.into = &recording;
  Random random(11);
  hand.take(kGrasper);
  wander(hand, random, 80);
  EXPECT_GT(hand.count(kSoftHeld), 5u);
  EXPECT_GT(hand.count(kSoftSlipped) + hand.count(kSoftFreed), 5u);
  ASSERT_GT(recording.states.size(), 8u);
  expect_same_replays(recording, run, session, {0.0, 0.6, 1.3, 2.1});
}

TEST(SoftGrip, AStateKeepsWhatIsHeldAndAWrongOneIsRefused) {
  const BandRun run = band_run();
  Session session = run.session();
  JawHand hand(session);
  hand.hold_band();
  hand.move(hand.at + Vec3(0, 0, 0.002), 51);
  Session other = run.session();
  const SessionState back = go_on_as(other, session);
  JawHand again(other);
  again.at = hand.at;
  for (JawHand* one : {&hand, &again}) one->move(one->at + Vec3(0, 0, 0.001), 101);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_TRUE(again.holds());
  EXPECT_LT(other.tool_state().force_W.z(), -2);
  for (const int wrong : {0, 1, 2}) {
    SessionState odd = back;
    SoftHold& hold = odd.world.softs.grips[0].hold;
    if (wrong == 0) hold.part = 7;
    if (wrong == 1) hold.share = 1;
    if (wrong == 2) hold.of = SoftHold::Of::kSolid;
    EXPECT_FALSE(other.restore(odd)) << wrong;
  }
  // Without jaws that hold nothing is held.
  BandRun bare;
  bare.settings.tray = run.settings.tray;
  bare.tray = run.tray;
  Session without = bare.session();
  EXPECT_FALSE(without.restore(back));
}

}  // namespace
}  // namespace osteon
