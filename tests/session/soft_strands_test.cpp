// A ligament that is cut and torn strand by strand in a session.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "count_allocations.h"
#include "driven_hand.h"
#include "osteon/base/random.h"
#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_fixtures.h"

namespace osteon {
namespace {

using testing::band_table;
using testing::BandRun;
using testing::begin_recording;
using testing::DrivenHand;
using testing::expect_same_replays;
using testing::kBandGap_m;
using testing::kBandRadius_m;
using testing::kBandStiffness_n;
using testing::kBandStrain;
using testing::kBandSurface_n_per_m;
using testing::kBandToe;
using testing::keep_tick;
using testing::kTouch_m;
using testing::shaft_at;

constexpr double kEdge_n = 4;
constexpr double kClears_m_per_s = 0.008;
constexpr double kPress_m_per_tick = 1e-5;

// The shaft is a blade as well where it is asked.
BandRun strand_run(bool sharp, const LigamentTable& table = band_table()) {
  BandRun run(table);
  Tool tool = testing::shaft_tool();
  tool.parts = {make_rod(Vec3(0, 0, 0), Vec3(0, 0, 0.025), testing::kShaftRadius_m)};
  run.tray = {std::make_shared<const Tool>(tool)};
  SoftSetup setup = *run.softs;
  if (sharp) add_blades(setup, {0}, kEdge_n);
  const std::uint64_t at_once = setup.hash;
  let_bands_part_by_strands(setup);
  EXPECT_NE(setup.hash, at_once);
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  return run;
}

struct Pressing {
  explicit Pressing(Session& s, double from_z_m = kTouch_m + 0.001) : session(s), z_m(from_z_m) {}
  Session& session;
  double z_m;
  std::vector<Event> events;
  void tick(double to_z_m) {
    z_m = to_z_m;
    (void)session.tick(shaft_at(z_m));
    for (const Event& event : session.last_events()) events.push_back(event);
  }
  const BandState& band() const { return session.softs()->state().bands[0]; }
  double left() const { return strands_left(band().gone); }
  std::vector<double> told(EventKind kind, std::size_t value) const {
    std::vector<double> out;
    for (const Event& event : events)
      if (event.kind == kind) out.push_back(event.values[value]);
    return out;
  }
};

// Of its strands so many are left, as if the others had been cut from one side.
void leave(Session& session, int strands) {
  SessionState state = session.save();
  std::uint64_t& gone = state.world.softs.bands[0].gone;
  for (int i = 0; i < kStrands - strands; ++i)
    gone |= std::uint64_t{1} << strand_under(gone, StrandAxes{}, Vec3::UnitX());
  ASSERT_TRUE(session.restore(state));
}

// The deeper an edge is pressed, the fewer are left; lifted, it stays as it was cut.
TEST(SoftStrands, ABladeCutsThemOneAfterTheOtherAsDeepAsItIsPressed) {
  const BandRun run = strand_run(true);
  Session session = run.session();
  Pressing blade(session);
  double before = 1;
  while (!blade.band().torn && blade.z_m > -0.02) {
    blade.tick(blade.z_m - kPress_m_per_tick);
    EXPECT_LE(before - blade.left(), 1.0 / kStrands + 1e-12);
    before = blade.left();
    if (before < 0.55) break;
  }
  ASSERT_GT(before, 0.4);
  ASSERT_FALSE(blade.band().torn);
  const std::vector<double> told = blade.told(kSoftStrandsCut, 0);
  ASSERT_EQ(told.size(), 5u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_NEAR(told[i], 100 - 10.0 * i, 2) << i;
  for (const double force : blade.told(kSoftStrandsCut, 1)) {
    EXPECT_GT(force, kEdge_n);
    EXPECT_LT(force, 1.2 * kEdge_n);
  }
  const Event first = *std::find_if(blade.events.begin(), blade.events.end(),
                                    [](const Event& e) { return e.kind == kSoftStrandsCut; });
  EXPECT_EQ(run.the_case->softs[first.subject].name, "acl");
  EXPECT_EQ(first.hand, 0);
  EXPECT_LT((first.p_W - testing::kBandMiddle).norm(), 0.008);
  for (int n = 0; n < 300; ++n) blade.tick(blade.z_m);  // rests: no more force than it needs
  before = blade.left();
  while (blade.z_m < kTouch_m + 0.002) blade.tick(blade.z_m + kPress_m_per_tick);
  EXPECT_EQ(blade.left(), before);
  const SoftPushes shown = session.softs()->pushes();  // still seen when nothing presses it
  ASSERT_EQ(shown.load_count, 1u);
  EXPECT_EQ(shown.loads[0].force_n[0], 0);
  EXPECT_EQ(shown.loads[0].left, before);
  EXPECT_EQ(blade.told(kSoftCut, 0).size(), 0u);
  while (!blade.band().torn && blade.z_m > -0.03) blade.tick(blade.z_m - kPress_m_per_tick);
  EXPECT_TRUE(blade.band().torn);
  for (int n = 0; n < 50; ++n) blade.tick(blade.z_m);
  EXPECT_EQ(blade.told(kSoftCut, 0).size(), 1u);
  EXPECT_EQ(blade.told(kSoftStrandsCut, 0).size(), 10u);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

// Pressed from below, where nothing is gone: two legs with the tension of what is left.
TEST(SoftStrands, WhatIsLeftPullsAsItsShareOfTheSection) {
  const double slack = kBandGap_m / (1 + kBandStrain);
  for (const int strands : {61, 40, 20, 5}) {
    const BandRun run = strand_run(false);
    Session session = run.session();
    leave(session, strands);
    const double deep = 0.006;
    for (int n = 0; n < 1200; ++n)
      (void)session.tick(shaft_at(std::min(-kTouch_m - 0.002 + 2e-5 * n, -kTouch_m + deep)));
    const double force = -session.tool_state().force_W.z();
    const double hollow =
        hollow_m(run.softs->bands[0], session.softs()->state().bands[0].gone,
                 section_of(run.softs->bands[0], {Vec3::Zero(), Vec3(kBandGap_m, 0, 0)}, Pose{}),
                 -Vec3::UnitZ());
    const double surface = std::min(2000.0, kBandSurface_n_per_m / std::pow(strands / 61.0, 0.25));
    const double bent = deep - hollow - force / surface;
    const double leg = std::hypot(kBandGap_m / 2, bent);
    const double tension = strands / 61.0 * kBandStiffness_n * (2 * leg / slack - 1 - kBandToe);
    EXPECT_NEAR(force, 2 * tension * bent / leg, 0.01 * force) << strands;
    EXPECT_NEAR(session.softs()->readout(0).tension_n, tension, 0.01 * tension) << strands;
  }
}

// Pulled aside by a hook until it tears: at the failure load times the share that is left, then one
// strand after the other as it is drawn further.
TEST(SoftStrands, ItTearsAtTheShareOfTheLoadThatIsLeft) {
  constexpr double kFailure_n = 150;
  for (const int strands : {7, 3, 1}) {
    const BandRun run = strand_run(false, band_table(0.004, kFailure_n));
    Session session = run.session();
    leave(session, strands);
    Pressing hook(session, -kTouch_m - 0.001);
    double peak = 0;
    int of_them = 0;
    std::uint64_t gone = hook.band().gone;
    const double weakest = strand_strength(weakest_strand(gone));
    while (!hook.band().torn && hook.z_m < 0.022) {
      hook.tick(hook.z_m + kPress_m_per_tick);
      peak = std::max(peak, session.softs()->readout(0).tension_n);
      if (hook.band().gone == gone) continue;
      gone = hook.band().gone;
      ++of_them;  // no more than one in a step
    }
    ASSERT_TRUE(hook.band().torn) << strands;
    EXPECT_EQ(of_them, strands);
    EXPECT_NEAR(peak, kFailure_n * weakest * strands / 61.0, 0.01 * peak) << strands;
    for (int n = 0; n < 50; ++n) hook.tick(hook.z_m);
    ASSERT_EQ(hook.told(kSoftTorn, 0).size(), 1u);
    EXPECT_GT(hook.told(kSoftTorn, 0)[0], 0.9 * kFailure_n / 61);
    EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  }
}

// A hand that pushes a whole ligament with all that it can does not tear it.
TEST(SoftStrands, AHealthyOneIsNotTornByAHand) {
  const BandRun run = strand_run(false);
  Session session = run.session();
  Pressing hook(session);
  while (hook.z_m > kTouch_m - 0.03) hook.tick(hook.z_m - kPress_m_per_tick);
  EXPECT_EQ(hook.band().gone, 0u);
}

// Of one that is whole every tick has the bits that it had.
TEST(SoftStrands, AWholeOneFeelsAsItDidToTheLastBit) {
  const BandRun with = strand_run(false);
  BandRun without = with;
  SoftSetup setup = *with.softs;
  setup.by_strands = false;
  without.softs = std::make_shared<const SoftSetup>(std::move(setup));
  Session a = with.session(), b = without.session();
  Random random(3);
  double x = 0, z = 0.008;
  for (int n = 0; n < 3000; ++n) {
    x = std::clamp(x + 0.0004 * random.uniform(-1, 1), -0.01, 0.01);
    z = std::clamp(z + 0.0004 * random.uniform(-1, 1), -0.01, 0.01);
    (void)a.tick(shaft_at(z, 0, x));
    (void)b.tick(shaft_at(z, 0, x));
    ASSERT_EQ(a.tool_state().force_W, b.tool_state().force_W) << n;
  }
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

TEST(SoftStrands, ACutComesBackFromAStateAndInAReplayAndARestorePointMakesItWhole) {
  const BandRun run = strand_run(true);
  Session session = run.session();
  Recording recording = begin_recording(run);
  for (int n = 0; n < 1500; ++n) {
    const double z = kTouch_m + 0.001 - 1e-5 * std::min(n, 680);
    (void)session.tick(shaft_at(z, 0, 0.004), n == 0 ? Command{CommandKind::kMark, 0} : Command{});
    keep_tick(recording, session, 250);
  }
  const BandState cut = session.softs()->state().bands[0];
  ASSERT_NE(cut.gone, 0u);
  ASSERT_FALSE(cut.torn);
  EXPECT_NEAR(cut.torn_share, 0.5 + 0.004 / kBandGap_m, 0.02);
  const SoftPushes pushes = session.softs()->pushes();
  ASSERT_EQ(pushes.notch_count, 1u);
  EXPECT_EQ(pushes.notches[0].gone, cut.gone);
  Session other = run.session();
  const SessionState back = testing::go_on_as(other, session);
  EXPECT_EQ(back.world.softs.bands[0].gone, cut.gone);
  for (int n = 0; n < 300; ++n) {
    const ToolInput input = shaft_at(kTouch_m - 0.008 - 1e-5 * n, 0, 0.004);
    const std::uint64_t before = testing::allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones());
    if (n % 2 == 0) (void)session.physics_step(tool);
    ASSERT_EQ(testing::allocations(), before) << n;
    (void)other.haptic_tick(input, other.bones());
    if (n % 2 == 0) (void)other.physics_step(other.tool_state());
  }
  EXPECT_EQ(session.tool_state().force_W, other.tool_state().force_W);
  EXPECT_EQ(session.state_hash(), other.state_hash());
  EXPECT_LT(strands_left(session.softs()->state().bands[0].gone), strands_left(cut.gone));
  Session again = run.session();
  ASSERT_TRUE(again.restore(back));
  expect_same_replays(recording, run, again, {0.0, 0.8, 1.3});
  (void)again.tick(shaft_at(0.02), {CommandKind::kRestore, 0});
  (void)again.tick(shaft_at(0.02));
  EXPECT_EQ(again.softs()->state().bands[0].gone, 0u);
  SessionState odd = back;
  odd.world.softs.bands[0].gone = ~std::uint64_t{0};
  EXPECT_FALSE(again.restore(odd));
}

// The shaft clears all round, or to one side, where it is let.
BandRun clearing_run(const Vec3& face_T, bool parts = true) {
  BandRun run = strand_run(false);
  Tool tool = *run.tray[0];
  tool.use.removes = true;
  run.tray = {std::make_shared<const Tool>(tool)};
  SoftSetup setup = *run.softs;
  SolidCutter with;
  with.way = SolidCutter::Way::kClear;
  with.works = 1;
  with.to_T = {0, 0, 0.025};
  with.face_T = face_T;
  with.speed_m_per_s = kClears_m_per_s;
  setup.biters = {with};
  if (parts) let_clearers_part_bands(setup);
  EXPECT_EQ(setup.hash != run.softs->hash, parts);
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  return run;
}

// Pressed 8 mm deep, then run for so long. Returns the strands that are gone.
int cleared(const BandRun& run, double power, int ticks) {
  Session session = run.session();
  Pressing shaver(session);
  while (shaver.z_m > kTouch_m - 0.008) shaver.tick(shaver.z_m - 10 * kPress_m_per_tick);
  (void)session.tick(shaft_at(shaver.z_m), {CommandKind::kPower, power});
  for (int n = 0; n < ticks; ++n) shaver.tick(shaver.z_m);
  const int gone = std::popcount(shaver.band().gone);
  const SoftTold told = session.bones().softs;
  EXPECT_EQ(told.loss_count, gone > 0 ? 1u : 0u);
  EXPECT_NEAR(told.losses[0].percent, 100.0 * gone / kStrands, 1e-9);
  EXPECT_GT(told.touches[0].force_n, 0.5);
  // The first, then each tenth.
  const int tenths = gone > 0 ? 1 + 10 * gone / kStrands : 0;
  EXPECT_EQ(shaver.told(kSoftStrandsCut, 0).size(), static_cast<std::size_t>(tenths));
  return gone;
}

// At its speed it is through all 6 mm in 0.75 s: 61 strands, one in 6 steps.
TEST(SoftStrands, WhatClearsTakesThemAtItsSpeedWhileItRuns) {
  const BandRun run = clearing_run(Vec3::Zero());
  const double through_s = 2 * kBandRadius_m / kClears_m_per_s;
  EXPECT_NEAR(cleared(run, 1, 300), 0.3 / through_s * kStrands, 2);
  EXPECT_NEAR(cleared(run, 0.5, 300), 0.15 / through_s * kStrands, 2);
  EXPECT_EQ(cleared(run, 0, 300), 0);
  EXPECT_EQ(cleared(clearing_run(Vec3::Zero(), false), 1, 300), 0);
}

// The shaft lies over the band: its own x or y is towards it, or away.
TEST(SoftStrands, WhatClearsToOneSideLeavesTheOther) {
  const Vec3 down_T = shaft_at(0).X_WD.q.conjugate() * -Vec3::UnitZ();
  EXPECT_GT(cleared(clearing_run(down_T), 1, 300), 20);
  EXPECT_EQ(cleared(clearing_run(-down_T), 1, 300), 0);
}

TEST(SoftStrands, NothingChangesWhereNothingClears) {
  SoftSetup setup = *strand_run(false).softs;
  const std::uint64_t before = setup.hash;
  let_clearers_part_bands(setup);
  setup.biters.resize(1);
  let_clearers_part_bands(setup);
  EXPECT_EQ(setup.hash, before);
  EXPECT_FALSE(setup.clearers_part);
}

/// A basket punch, which bites where it is let.
BandRun punch_run(bool bites) {
  BandRun run;
  const auto instruments = load_instruments();
  EXPECT_TRUE(instruments);
  const Instrument* found = find_instrument(*instruments, "basket_punch");
  run.settings.tray.emplace_back("basket_punch");
  run.tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
  SoftSetup setup = *run.softs;
  auto grippers = make_soft_grippers(run.settings.tray);
  auto biters = make_solid_cutters(run.settings.tray);
  EXPECT_TRUE(grippers && biters);
  add_grippers(setup, std::move(*grippers));
  setup.biters = std::move(*biters);
  let_bands_part_by_strands(setup);
  const std::uint64_t holds = setup.hash;
  if (bites) let_hooks_tear_and_punches_bite(setup);
  EXPECT_EQ(setup.hash != holds, bites);
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  return run;
}

// The punch stands upright, its mouth open to y; the band lies in it, its middle so far over the
// tool's own.
void bite_at(DrivenHand& hand, double over_m) {
  const Vec3 at = testing::kBandMiddle - Vec3(0, over_m, 0.003);
  hand.take(1);
  hand.tick({CommandKind::kJaw, 1});
  hand.move(at - Vec3(0, 0.010, 0), 100);
  hand.move(at, 200);
  hand.tick({CommandKind::kJaw, 0});
  hand.rest(20);
}

// What of the round section lies between the jaws: a segment of the circle is left under the foot's
// face, 0.3 mm under the tool's middle.
TEST(SoftStrands, APunchTakesTheStrandsBetweenItsJaws) {
  const BandRun run = punch_run(true);
  const double r = testing::kBandRadius_m;
  for (const double over_m : {0.0005, 0.0020}) {
    Session session = run.session();
    DrivenHand hand(session, testing::kBandMiddle + Vec3(0, -0.030, 0));
    bite_at(hand, over_m);
    const double angle = std::acos((over_m + 0.0003) / r);
    const double left = (angle - std::sin(angle) * std::cos(angle)) / std::numbers::pi;
    const BandState& band = session.softs()->state().bands[0];
    EXPECT_NEAR(strands_left(band.gone), left, 0.07) << over_m;
    EXPECT_FALSE(band.torn);
    EXPECT_NEAR(band.torn_share, 0.5, 0.01);
    EXPECT_GT(hand.count(kSoftStrandsCut), 5u);
    EXPECT_EQ(hand.count(kSoftHeld), 0u);
    // Shut jaws bite nothing more; opened and shut again at the same place neither.
    const std::uint64_t gone = band.gone;
    hand.tick({CommandKind::kJaw, 1});
    hand.rest(20);
    hand.tick({CommandKind::kJaw, 0});
    hand.rest(20);
    EXPECT_EQ(session.softs()->state().bands[0].gone, gone);
  }
}

// Before punches bit ligaments they held them; and one beside the mouth is whole.
TEST(SoftStrands, APunchBitesNothingBesideItsMouthAndHoldsWhereItDoesNotBite) {
  {
    const BandRun run = punch_run(false);
    Session session = run.session();
    DrivenHand hand(session, testing::kBandMiddle + Vec3(0, -0.030, 0));
    bite_at(hand, 0.0005);
    EXPECT_EQ(session.softs()->state().bands[0].gone, 0u);
    EXPECT_EQ(hand.count(kSoftHeld), 1u);
  }
  const BandRun run = punch_run(true);
  Session session = run.session();
  DrivenHand hand(session, testing::kBandMiddle + Vec3(0, -0.030, 0));
  bite_at(hand, -0.0040);
  EXPECT_EQ(session.softs()->state().bands[0].gone, 0u);
}

TEST(SoftStrands, WhatAPunchBitesReplaysTheSame) {
  const BandRun run = punch_run(true);
  Session session = run.session();
  Recording recording = begin_recording(run);
  DrivenHand hand(session, testing::kBandMiddle + Vec3(0, -0.030, 0));
  hand.into = &recording;
  hand.store_every = 100;
  bite_at(hand, 0.0010);
  hand.rest(100);
  ASSERT_GT(hand.count(kSoftStrandsCut), 0u);
  expect_same_replays(recording, run, session, {0.0, 0.2, 0.4});
}

}  // namespace
}  // namespace osteon
