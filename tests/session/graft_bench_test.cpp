// A bench in a session: a stripper is led and stopped, the hand feels it, and everything repeats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "count_allocations.h"
#include "graft_bench_case.h"
#include "osteon/base/turn.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "osteon/session/session.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::go_on_as;

const std::shared_ptr<const Case>& felt_bench() {
  static const std::shared_ptr<const Case> made = testing::bench_case(testing::bench_def(true));
  return made;
}

struct BenchSession {
  BenchSession() {
    settings.tray = {"tendon_stripper"};
    const auto all = load_instruments();
    EXPECT_TRUE(all);
    const Instrument* found = find_instrument(*all, "tendon_stripper");
    tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
    recording.header = recording_header(*felt_bench(), settings, "test", "0", tray);
  }
  Session session() const { return Session(felt_bench(), settings, tray); }
  SessionSettings settings;
  Tray tray;
  Recording recording;
};

// Comes in line with the second tendon, is taken on, and is pushed on through its band.
HandInput strip_hand(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double x = t < 0.6 ? -0.02 + 0.03 * t : t < 1 ? -0.002 : -0.002 + 0.08 * (t - 1);
  HandInput hand;
  hand.input.X_WD = {Vec3(x, -0.012, -0.008), turn_between(Vec3::UnitZ(), Vec3(-Vec3::UnitX()))};
  if (n == 1400) hand.command = {CommandKind::kMark, 1};
  return hand;
}

void strip_on(Session& session, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n <= to; ++n) {
    const HandInput hand = strip_hand(n);
    (void)session.tick(std::span(&hand, 1));
  }
}

const TendonOnBench& gracilis(const Session& session) { return session.bones().bench.tendons[1]; }

TEST(SessionBench, TheHandFeelsTheStripperAndTheBandBeforeItGivesWay) {
  const BenchSession rig;
  Session session = rig.session();
  strip_on(session, 1, 1600);
  EXPECT_GT(gracilis(session).front_m, 0.01);
  const double on_the_way = -session.tool_state().force_W.x();
  EXPECT_GT(on_the_way, 1.0);
  EXPECT_LT(on_the_way, 4.0);
  double most = 0;
  const std::size_t before = testing::allocations();
  for (std::uint64_t n = 1601; n <= 2200; ++n) {
    strip_on(session, n, n);
    most = std::max(most, -session.tool_state().force_W.x());
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(most, 5.0);
  EXPECT_TRUE(gracilis(session).amputated);
}

TEST(SessionBench, AStateInTheMiddleGoesOnWithTheSameBits) {
  const BenchSession rig;
  for (const std::uint64_t stop : {700u, 1500u}) {
    Session session = rig.session();
    strip_on(session, 1, stop);
    Session other = rig.session();
    (void)go_on_as(other, session);
    strip_on(session, stop + 1, 2000);
    strip_on(other, stop + 1, 2000);
    EXPECT_EQ(other.state_hash(), session.state_hash()) << stop;
    SessionState odd = session.save();
    odd.world.bones.bench.on = false;
    EXPECT_FALSE(other.restore(odd));
  }
}

// Where the bytes of a state differ first once it was changed.
std::size_t word_of(const SessionState& state, const std::function<void(SessionState&)>& change) {
  SessionState odd = state;
  change(odd);
  const std::string a = to_bytes(state), b = to_bytes(odd);
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin()) /
         8 * 8;
}

// Before muscle and thread were known every tendon was clean and stitched.
TEST(SessionBench, AStateFromBeforeTableWorkIsReadAsClean) {
  const BenchSession rig;
  Session session = rig.session();
  strip_on(session, 1, 700);
  SessionState state = session.save();
  for (TendonOnBench& tendon : state.world.bones.bench.tendons) {
    tendon.scraped_m = kScrapedClean_m;
    tendon.stitches = (1u << kMostStitches) - 1;
  }
  // Nor did fascia cover any, or was any tip known to be in anything.
  state.world.bones.inside = {};
  state.hands[0].watch.inside = {};
  const Inside fat{SubjectKind::kSoftPart, 0, 1, 1, 0};
  std::vector<std::size_t> words;
  const auto note = [&](const auto& change) { words.push_back(word_of(state, change)); };
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    note([&](SessionState& s) { s.world.bones.bench.tendons[t].scraped_m = 0; });
    note([&](SessionState& s) { s.world.bones.bench.tendons[t].stitches = 0; });
    note([&](SessionState& s) { s.world.bones.bench.tendons[t].found = false; });
  }
  for (std::size_t h = 0; h < kBenchHands; ++h) {
    note([&](SessionState& s) { s.world.bones.bench.hands[h].scrapes = 1; });
    note([&](SessionState& s) { s.world.bones.bench.hands[h].slits = 1; });
    note([&](SessionState& s) { s.world.bones.bench.hands[h].lifts = 1; });
    note([&](SessionState& s) { s.world.bones.inside[h][0] = fat; });
  }
  note([&](SessionState& s) { s.hands[0].watch.inside[0] = fat; });
  note([&](SessionState& s) { s.world.bones.bench.slit = 0; });
  note([&](SessionState& s) { s.world.bones.bench.hurt = 1; });
  std::sort(words.rbegin(), words.rend());
  std::string old = to_bytes(state);
  for (const std::size_t at : words) old.erase(at, 8);
  ASSERT_EQ(old[0], 38);
  old[0] = 24;
  const auto read = state_from_bytes(old);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_bytes(*read), to_bytes(state));
}

// A clamp sets on over the gracilis where the fascia is open, shuts, and is drawn up 20 mm.
HandInput lift_hand(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double z = t < 0.4 ? 0.006 * (1 - t / 0.4) : t < 1 ? 0 : std::min(0.020, 0.02 * (t - 1));
  HandInput hand;
  hand.input.X_WD = {Vec3(0.024, -0.012, z), Quat::Identity()};
  if (n == 100) hand.command = {CommandKind::kJaw, 1};
  if (n == 500) hand.command = {CommandKind::kJaw, 0};
  return hand;
}

TEST(SessionBench, TheHandFeelsATendonThatItLiftsOutOfTheFascia) {
  BenchSession rig;
  const auto covered = testing::bench_case(testing::covered_bench_def(true));
  rig.settings.tray = {"clamp"};
  const auto all = load_instruments();
  ASSERT_TRUE(all);
  const Instrument* clamp = find_instrument(*all, "clamp");
  rig.tray = {std::make_shared<const Tool>(make_tool(*clamp, clamp->usual_size))};
  Session session(covered, rig.settings, rig.tray);
  SessionState open = session.save();
  open.world.bones.bench.slit = kFasciaOpen;
  ASSERT_TRUE(session.restore(open));
  double last = 0, most_step = 0, most = 0;
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const HandInput hand = lift_hand(n);
    (void)session.tick(std::span(&hand, 1));
    const double down = -session.tool_state().force_W.z();
    if (n > 1000) most_step = std::max(most_step, std::abs(down - last));
    most = std::max(most, down);
    last = down;
  }
  EXPECT_TRUE(gracilis(session).found);
  EXPECT_FALSE(session.bones().bench.tendons[0].found);
  EXPECT_GT(most, 1.5);
  EXPECT_LT(most, 4);
  EXPECT_LT(most_step, 0.1) << "without steps";
}

// A blade is pressed on the fascia and drawn along it.
HandInput slit_hand(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double down = -std::min(0.003, 0.01 * t) + 0.001;
  HandInput hand;
  hand.input.X_WD = {Vec3(0.008 + 0.02 * std::max(0.0, t - 0.4), 0, down), Quat::Identity()};
  return hand;
}

TEST(SessionBench, FasciaThatIsOpenedRepeatsAndIsKept) {
  BenchSession rig;
  const auto covered = testing::bench_case(testing::covered_bench_def(true));
  rig.settings.tray = {"scalpel_15"};
  const auto all = load_instruments();
  ASSERT_TRUE(all);
  const Instrument* blade = find_instrument(*all, "scalpel_15");
  rig.tray = {std::make_shared<const Tool>(make_tool(*blade, blade->usual_size))};
  rig.recording.header = recording_header(*covered, rig.settings, "test", "0", rig.tray);
  Session session(covered, rig.settings, rig.tray);
  const auto plan = find_graft_bench(*covered);
  ASSERT_TRUE(plan);
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    const HandInput hand = slit_hand(n);
    (void)session.tick(std::span(&hand, 1));
    rig.recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) rig.recording.steps.push_back(session.last_step_record());
    if (n % 300 != 0) continue;
    const auto read = state_from_bytes(to_bytes(session.save()));
    ASSERT_TRUE(read) << n << " " << std::hex << session.bones().bench.slit;
    EXPECT_EQ(read->world.bones.bench.slit, session.bones().bench.slit);
  }
  EXPECT_NEAR(fascia_open_m(*plan, session.bones().bench), 0.022, 0.002);
  EXPECT_EQ(session.bones().bench.hurt, 0u);
  rig.recording.complete = true;
  ReplayOptions options;
  options.tray = rig.tray;
  const auto again = replay(rig.recording, covered, options);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
}

TEST(SessionBench, ARecordingRepeatsAndARestorePointPutsTheFrontBack) {
  BenchSession rig;
  Session session = rig.session();
  double marked = 0;
  for (std::uint64_t n = 1; n <= 2100; ++n) {
    HandInput hand = strip_hand(n);
    if (n == 2000) hand.command = {CommandKind::kRestore, 1};
    (void)session.tick(std::span(&hand, 1));
    rig.recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) rig.recording.steps.push_back(session.last_step_record());
    if (n == 1400) marked = gracilis(session).front_m;
    if (n == 1999) {
      EXPECT_GT(gracilis(session).front_m, marked + 0.005);
    }
  }
  EXPECT_GT(marked, 0.005);
  EXPECT_NEAR(gracilis(session).front_m, marked, 0.001);
  rig.recording.complete = true;
  ReplayOptions options;
  options.tray = rig.tray;
  const auto again = replay(rig.recording, felt_bench(), options);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
}

}  // namespace
}  // namespace osteon
