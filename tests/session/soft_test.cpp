// A ligament between two bones, pressed and pulled by a shaft in a session.
#include <gtest/gtest.h>

#include <cmath>

#include "count_allocations.h"
#include "osteon/base/random.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_fixtures.h"

namespace osteon {
namespace {

using testing::allocations;
using testing::band_table;
using testing::BandRun;
using testing::begin_recording;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::kBandGap_m;
using testing::kBandStiffness_n;
using testing::kBandStrain;
using testing::kBandSurface_n_per_m;
using testing::kBandToe;
using testing::keep_tick;
using testing::kTouch_m;
using testing::shaft_at;

constexpr double kSpeed_m_per_s = 0.02;

// Comes down from 2 mm above the touch to `deep_m` beyond it, then rests there.
double height_at(std::uint64_t n, double deep_m) {
  return std::max(kTouch_m + 0.002 - kSpeed_m_per_s * 1e-3 * static_cast<double>(n),
                  kTouch_m - deep_m);
}

void press_to(Session& session, std::uint64_t from, std::uint64_t to, double deep_m,
              std::vector<Event>* events = nullptr, double x_m = 0) {
  for (std::uint64_t n = from; n <= to; ++n) {
    (void)session.tick(shaft_at(height_at(n, deep_m), 0, x_m));
    if (!events) continue;
    for (const Event& event : session.last_events()) events->push_back(event);
  }
}

std::size_t count_of(const std::vector<Event>& events, EventKind kind) {
  return static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(), [kind](const Event& event) { return event.kind == kind; }));
}

double force_at(double deep_m, double x_m = 0, double strain = kBandStrain) {
  const BandRun run(band_table(strain));
  Session session = run.session();
  press_to(session, 1, 1200, deep_m, nullptr, x_m);
  return session.tool_state().force_W.z();
}

// Two straight legs to the shaft, tension T = k (strain - toe): across the band they push with
// T (sin a + sin b). What the hand is deeper than the string has given way is in its surface.
TEST(Soft, PressedSidewaysItIsAStringOfTwoLegs) {
  const double slack = kBandGap_m / (1 + kBandStrain);
  for (const double x : {0.0, 0.006, -0.009})
    for (const double deep : {0.001, 0.003, 0.006, 0.010}) {
      const double force = force_at(deep, x);
      const double bent = deep - force / kBandSurface_n_per_m;
      const double leg_a = std::hypot(kBandGap_m / 2 + x, bent);
      const double leg_b = std::hypot(kBandGap_m / 2 - x, bent);
      const double tension = kBandStiffness_n * ((leg_a + leg_b) / slack - 1 - kBandToe);
      ASSERT_GT(bent, 0);
      EXPECT_NEAR(force, tension * (bent / leg_a + bent / leg_b), 0.01 * force) << x << " " << deep;
    }
}

TEST(Soft, ATautOneFeelsAsStiffAsTheTissueTableSays) {
  const double stiffness = (force_at(0.0015) - force_at(0.0005)) / 0.001;
  EXPECT_NEAR(stiffness, kBandSurface_n_per_m, 0.15 * kBandSurface_n_per_m);
}

TEST(Soft, ASlackOneGivesWayUntilItIsStraight) {
  EXPECT_LT(force_at(0.002, 0, -0.05), 0.01);
  EXPECT_GT(force_at(0.012, 0, -0.05), 1);
}

TEST(Soft, ATornOneIsNotFelt) {
  const BandRun whole, torn(band_table(), "acl_tear");
  Session of_whole = whole.session(), of_torn = torn.session();
  press_to(of_whole, 1, 800, 0.003);
  press_to(of_torn, 1, 800, 0.003);
  EXPECT_GT(of_whole.tool_state().force_W.z(), 1.5);
  EXPECT_EQ(of_torn.tool_state().force_W, Vec3(0, 0, 0));
}

// From below it is pulled up: the shaft keeps its side through the band's rest place.
TEST(Soft, HookedAndPulledItHoldsBack) {
  const BandRun run;
  Session session = run.session();
  for (int n = 0; n < 1000; ++n) (void)session.tick(shaft_at(-0.006 + 1e-5 * n));
  EXPECT_LT(session.tool_state().force_W.z(), -4);
  for (int n = 0; n < 60; ++n) (void)session.tick(shaft_at(-0.006));
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

TEST(Soft, WhatBeginsInsideIsNotFeltUntilItHasBeenOut) {
  const BandRun run;
  Session session = run.session();
  for (int n = 0; n < 100; ++n) (void)session.tick(shaft_at(0.001));
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  for (int n = 0; n < 100; ++n) (void)session.tick(shaft_at(kTouch_m + 0.001));
  for (int n = 0; n < 100; ++n) (void)session.tick(shaft_at(kTouch_m + 0.001 - 5e-5 * n));
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

TEST(Soft, EventsNameThePartAndEndWithThePeak) {
  const BandRun run;
  Session session = run.session();
  std::vector<Event> events;
  press_to(session, 1, 700, 0.008, &events);
  EXPECT_EQ(count_of(events, kSoftBegin), 1u);
  EXPECT_EQ(count_of(events, kSoftOver), 1u);
  const double peak = session.softs()->readout(0).force_n[0];
  events.clear();
  for (int n = 0; n < 300; ++n) {
    (void)session.tick(shaft_at(kTouch_m + 0.003));
    for (const Event& event : session.last_events()) events.push_back(event);
  }
  ASSERT_EQ(count_of(events, kSoftEnd), 1u);
  const Event end = *std::find_if(events.begin(), events.end(),
                                  [](const Event& e) { return e.kind == kSoftEnd; });
  EXPECT_EQ(end.subject_kind, SubjectKind::kSoftPart);
  EXPECT_EQ(run.the_case->softs[end.subject].name, "acl");
  EXPECT_EQ(end.hand, 0);
  EXPECT_NEAR(end.values[1], peak, 0.01 * peak);
  EXPECT_NEAR(end.values[2], 8, 0.1);
}

// A slow press of 1 Hz: the force comes and goes without steps.
TEST(Soft, ASlowPressHasNoSteps) {
  const BandRun run;
  Session session = run.session();
  double last = 0, peak = 0, step = 0;
  for (int n = 0; n < 1000; ++n) {
    const double turn = 2 * std::numbers::pi * 1e-3 * n;
    const double z = kTouch_m + 0.0005 - 0.00175 * (1 - std::cos(turn));
    (void)session.tick(shaft_at(z, -0.00175 * 2 * std::numbers::pi * std::sin(turn)));
    const double force = session.tool_state().force_W.norm();
    if (n > 0) step = std::max(step, std::abs(force - last));
    last = force;
    peak = std::max(peak, force);
  }
  EXPECT_GT(peak, 1.5);
  EXPECT_LT(step, 0.02 * peak);
}

TEST(Soft, AtItsFailureLoadItTearsAndAMarkMakesItWhole) {
  const BandRun run(band_table(0.004, 35));
  Session session = run.session();
  std::vector<Event> events;
  (void)session.tick(shaft_at(0.010), {CommandKind::kMark, 0});
  press_to(session, 2, 900, 0.012, &events);
  ASSERT_EQ(count_of(events, kSoftTorn), 1u);
  EXPECT_EQ(count_of(events, kSoftEnd), 1u);
  EXPECT_TRUE(session.softs()->state().bands[0].torn);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  (void)session.tick(shaft_at(0.010), {CommandKind::kRestore, 0});
  for (int n = 0; n < 200; ++n) (void)session.tick(shaft_at(0.010));
  EXPECT_FALSE(session.softs()->state().bands[0].torn);
  press_to(session, 1, 300, 0.003);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

// A blade cuts where it presses as hard as the tissue resists; the same shaft, blunt, does not.
TEST(Soft, ABladeCutsItInTwoAndABluntShaftDoesNot) {
  for (const bool sharp : {false, true}) {
    BandRun run;
    Tool blade = testing::shaft_tool();
    blade.parts = {make_rod(Vec3(0, 0, 0), Vec3(0, 0, 0.025), testing::kShaftRadius_m)};
    run.tray = {std::make_shared<const Tool>(blade)};
    SoftSetup setup = *run.softs;
    const std::uint64_t blunt_hash = setup.hash;
    if (sharp) add_blades(setup, {0}, 2);
    EXPECT_EQ(setup.hash != blunt_hash, sharp);
    run.softs = std::make_shared<const SoftSetup>(setup);
    Session session = run.session();
    std::vector<Event> events;
    press_to(session, 1, 700, 0.006, &events);
    EXPECT_EQ(count_of(events, kSoftCut), sharp ? 1u : 0u);
    EXPECT_EQ(session.softs()->state().bands[0].torn, sharp);
    if (!sharp) continue;
    EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
    const Event cut = *std::find_if(events.begin(), events.end(),
                                    [](const Event& e) { return e.kind == kSoftCut; });
    EXPECT_EQ(run.the_case->softs[cut.subject].name, "acl");
    EXPECT_GT(cut.values[0], 2);
    EXPECT_LT(cut.values[0], 3);
    EXPECT_LT((cut.p_W - testing::kBandMiddle).norm(), 0.006);
  }
}

TEST(Soft, AStateGivesTheSameBitsAfterwards) {
  const BandRun run;
  Session session = run.session();
  press_to(session, 1, 301, 0.006);
  Session other = run.session();
  const SessionState back = go_on_as(other, session);
  press_to(session, 302, 600, 0.006);
  press_to(other, 302, 600, 0.006);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.tool_state().force_W, session.tool_state().force_W);
  EXPECT_GT(other.tool_state().force_W.z(), 1);
  BandRun hard = run;
  hard.softs = nullptr;
  Session without = hard.session();
  EXPECT_FALSE(without.restore(back));
}

constexpr std::size_t kWordsAfterSofts = 1 + kMaxMarks + 2;  // rings, marks, command

std::string bytes_of_35(const SessionState& saved) {
  std::string bytes = to_bytes(saved);
  testing::erase_more_bands(bytes, saved);
  return bytes;
}

// Versions before 11 knew no water: its words, of which the first says that there is any. Behind it
// stand those of versions 12 and 13: no graft is placed or was ordered, no joint is bent. Versions
// 14, 22 and 24 have one more each, behind all that is soft: nothing was cut, no jaws hold
// anything, and no skin is felt. Version 23 has one in the hand: no scope has seen anything; and
// version 26 one behind it, and one for each hand behind the joint: no tip is in anything.
std::string without_words_since(SessionState saved) {
  const std::string with = bytes_of_35(saved);
  saved.world.bones.water = {};
  std::string bytes = bytes_of_35(saved);
  const auto differ = std::mismatch(bytes.begin(), bytes.end(), with.begin());
  bytes.erase(static_cast<std::size_t>(differ.first - bytes.begin()) / 8 * 8,
              8 * (5 + kPlacingNumbers + kMaxHands));
  bytes.erase(bytes.size() - 8 * (kWordsAfterSofts + 3), 24);
  const std::string blind = bytes_of_35(saved);
  saved.hands[0].watch.seen[0] = 1;
  const std::string looked = bytes_of_35(saved);
  const auto sees = std::mismatch(blind.begin(), blind.end(), looked.begin()).first;
  bytes.erase(static_cast<std::size_t>(sees - blind.begin()) / 8 * 8, 16);
  return bytes;
}

// Nor did versions before 32 know where other hands draw a band aside: seven words of each part
// that is near one.
std::string without_water(const SessionState& saved) {
  constexpr std::size_t kAside = 7 * 8;
  const std::string with = without_words_since(saved);
  std::string bytes = with;
  const auto& hands = saved.world.softs.hands;
  for (std::size_t h = hands.size(); h-- > 0;)
    for (std::size_t i = hands[h].count; i-- > 0;) {
      SessionState other = saved;
      other.world.softs.hands[h].near[i].contact.off_W.x() += 1;
      const std::string moved = without_words_since(other);
      const auto differ = std::mismatch(with.begin(), with.end(), moved.begin()).first;
      bytes.erase(static_cast<std::size_t>(differ - with.begin()) / 8 * 8, kAside);
    }
  return bytes;
}

// Versions before 9 knew no friction on soft parts: its four words, in the state of the hand.
void erase_rub(std::string& bytes, SessionState saved) {
  constexpr std::size_t kWord = 8, kRub = 4;
  const std::string without = without_water(saved);
  saved.hands[0].haptic.rub.lag_W.setConstant(1);
  const std::string with = without_water(saved);
  const auto differ = std::mismatch(without.begin(), without.end(), with.begin());
  const auto at = static_cast<std::size_t>(differ.first - without.begin());
  bytes.erase(at / kWord * kWord, kRub * kWord);
}

TEST(Soft, AStateFromBeforeFrictionIsReadWithoutIt) {
  BandRun run;
  run.settings.water = false;  // as its recording's settings were
  Session session = run.session();
  press_to(session, 1, 301, 0.006);
  std::string bytes = without_water(session.save());
  ASSERT_EQ(bytes[0], 38);
  bytes[0] = 8;
  erase_rub(bytes, session.save());
  const auto back = state_from_bytes(bytes);
  ASSERT_TRUE(back) << back.error().message();
  Session other = run.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

// A twelfth band's state is kept; one of version 35 with eight bands is read, and has the hash it
// had.
TEST(Soft, AStateKeepsMoreThanEightBands) {
  BandRun run;
  Session session = run.session();
  press_to(session, 1, 301, 0.006);
  SessionState saved = session.save();
  saved.world.softs.bands[kMaxBands - 1].lost = true;
  saved.world.softs.hands[0].touches[kMaxBands - 1].peak_n = 3;
  const auto back = state_from_bytes(to_bytes(saved));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_TRUE(back->world.softs.bands[kMaxBands - 1].lost);
  EXPECT_EQ(back->world.softs.hands[0].touches[kMaxBands - 1].peak_n, 3);
  std::string old = bytes_of_35(session.save());
  old[0] = 35;
  const auto before = state_from_bytes(old);
  ASSERT_TRUE(before) << before.error().message();
  Session other = run.session();
  ASSERT_TRUE(other.restore(*before));
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

// Version 6 of the state's bytes knew no solids: their words stood nowhere.
TEST(Soft, AStateFromBeforeSolidsIsReadWithoutThem) {
  BandRun run;
  run.settings.water = false;  // as its recording's settings were
  Session session = run.session();
  press_to(session, 1, 301, 0.006);
  SessionState saved = session.save();
  std::string bytes = without_water(saved);
  saved.world.bones.bench.on = true;
  const std::string with_bench = without_water(saved);
  constexpr std::size_t kWord = 8, kTouch = 6;
  constexpr std::size_t kSolids = kMaxSolids + kMaxHands * (2 + kMaxSolids * kTouch);
  ASSERT_EQ(bytes[0], 38);
  bytes[0] = 6;
  bytes.erase(bytes.size() - (kWordsAfterSofts + kSolids) * kWord, kSolids * kWord);
  // Nor was there a bench: the word that says so is where the two differ first.
  const auto differ = std::mismatch(bytes.begin() + 1, bytes.end(), with_bench.begin() + 1);
  const auto at = static_cast<std::size_t>(differ.first - bytes.begin());
  bytes.erase(at / kWord * kWord, kWord);
  erase_rub(bytes, session.save());
  const auto back = state_from_bytes(bytes);
  ASSERT_TRUE(back) << back.error().message();
  Session other = run.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

ToolInput wandering(Random& random, Vec3& at) {
  at += 0.0008 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  at = at.cwiseMax(Vec3(-0.012, -0.02, -0.012)).cwiseMin(Vec3(0.012, 0.03, 0.012));
  ToolInput input = shaft_at(at.z(), 0, at.x());
  input.X_WD.p.y() += at.y();
  const double turn = 0.4 * at.x() / 0.012;
  input.X_WD.q = (Quat(Eigen::AngleAxisd(turn, Vec3::UnitX())) * input.X_WD.q).normalized();
  return input;
}

TEST(Soft, AReplayIsTheSameFromTheStartAndFromTheMiddle) {
  const BandRun run;
  Session session = run.session();
  Recording recording = begin_recording(run);
  Random random(5);
  Vec3 at(0, 0, 0.008);
  std::size_t touched = 0;
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    (void)session.tick(wandering(random, at));
    keep_tick(recording, session, 500);
    touched += session.tool_state().force_W.isZero(0) ? 0 : 1;
  }
  EXPECT_GT(touched, 200u);
  recording.complete = true;
  ReplayOptions without;
  without.tray = run.tray;
  EXPECT_FALSE(replay(recording, run.the_case, without));  // without the soft parts
  expect_same_replays(recording, run, session, {0.0, 1.2});
}

// Where a blade has cut is kept in a state and comes back; no place that is none is taken.
TEST(Soft, AStateKeepsWhereItWasCutAndAReplayCutsThere) {
  BandRun run;
  SoftSetup setup = *run.softs;
  add_blades(setup, {0}, 2);
  run.softs = std::make_shared<const SoftSetup>(setup);
  run.settings.soft_hash = setup.hash;
  Tool blade = testing::shaft_tool();
  blade.parts = {make_rod(Vec3(0, 0, 0), Vec3(0, 0, 0.025), testing::kShaftRadius_m)};
  run.tray = {std::make_shared<const Tool>(blade)};
  Session session = run.session();
  Recording recording = begin_recording(run);
  constexpr double kAside_m = 0.006, kFrom_m = testing::kTouch_m + 0.003;
  for (std::uint64_t n = 1; n <= 1000; ++n) {
    const double z = kFrom_m - 0.009 * std::min(1.0, static_cast<double>(n) / 600);
    (void)session.tick(shaft_at(z, 0, kAside_m));
    keep_tick(recording, session, 250);
  }
  const double share = 0.5 + kAside_m / testing::kBandGap_m;
  const SoftPushes pushes = session.softs()->pushes();
  ASSERT_EQ(pushes.break_count, 1u);
  EXPECT_NEAR(pushes.breaks[0].share, share, 0.02);
  const auto back = state_from_bytes(recording.states.back().bytes);
  ASSERT_TRUE(back) << back.error().message();
  Session other = run.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.softs()->pushes().breaks, pushes.breaks);
  expect_same_replays(recording, run, session, {0.0, 0.8});
  // Version 9 had no word for the place.
  SessionState elsewhere = session.save();
  std::string old = without_water(elsewhere);
  elsewhere.world.softs.bands[0].torn_share = -1;
  const std::string differs = without_water(elsewhere);
  const auto word = std::mismatch(old.begin(), old.end(), differs.begin()).first - old.begin();
  old.erase(static_cast<std::size_t>(word) / 8 * 8, 8);
  old[0] = 9;
  const auto from_9 = state_from_bytes(old);
  ASSERT_TRUE(from_9) << from_9.error().message();
  EXPECT_TRUE(from_9->world.softs.bands[0].torn);
  EXPECT_EQ(from_9->world.softs.bands[0].torn_share, 0.5);
  SessionState broken = session.save();
  broken.world.softs.bands[0].torn_share = std::nan("");
  EXPECT_FALSE(other.restore(broken));
}

// However wild the hand, and whatever sample it gives: a finite force, and nothing from the heap.
TEST(Soft, WildHandsAndNoAllocation) {
  const BandRun run;
  Session session = run.session();
  Random random(9);
  Vec3 at(0, 0, 0.02);
  for (std::uint64_t n = 1; n <= 20000; ++n) {
    if (n % 3 == 0) at += 0.004 * Vec3(random.uniform(-1, 1), 0, random.uniform(-1, 1));
    ToolInput input = wandering(random, at);
    if (n % 701 == 0) input.X_WD.p.z() = std::nan("");
    const std::uint64_t before = allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones());
    ASSERT_EQ(allocations(), before) << n;
    ASSERT_TRUE(is_finite(tool.force_W));
    ASSERT_LE(tool.force_W.norm(), 40.0001);
    if (n % 2 == 0) (void)session.physics_step(tool);
    ASSERT_EQ(allocations(), before) << n;
  }
}

TEST(Soft, TheSettingsComeBackAndStayAsTheyWereWithoutSoftParts) {
  const BandRun run;
  const auto back = parse_settings(to_json(run.settings));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->soft, run.settings.soft);
  EXPECT_EQ(back->soft_hash, run.settings.soft_hash);
  EXPECT_EQ(to_json(SessionSettings{}).find("\"soft\""), std::string::npos);
  EXPECT_FALSE(parse_settings(R"({"soft": ["acl"]})"));
}

}  // namespace
}  // namespace osteon
