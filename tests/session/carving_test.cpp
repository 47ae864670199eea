// Bone removed in a session: a drill goes into a block that is felt as a field.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "drilling.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/carving_setup.h"
#include "osteon/scene/carve_events.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::down_at;
using testing::Drilling;
using testing::go_on_as;
using testing::kTop_m;

void run(Session& session, std::uint64_t from, std::uint64_t to, double power,
         std::vector<Event>* events = nullptr) {
  for (std::uint64_t n = from; n <= to; ++n) {
    const HandInput hand = down_at(n, power);
    (void)session.tick(std::span(&hand, 1));
    if (events)
      for (const Event& event : session.last_events()) events->push_back(event);
  }
}

double removed_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

TEST(Carving, ADrillThatDoesNotTurnRemovesNothing) {
  const Drilling with;
  Session session = with.session();
  run(session, 1, 1500, 0);
  EXPECT_EQ(removed_mm3(session), 0);
  EXPECT_GT(session.tool_state().force_W.z(), 5);
}

// What is gone is the drill's point and shank down to where the tip stands, and no more: the tip
// follows what was removed.
TEST(Carving, ADrillGoesInByWhatItRemovesAndFeelsItsHole) {
  const Drilling with;
  Session session = with.session();
  std::vector<Event> events;
  run(session, 1, 6000, 1, &events);
  const double depth = kTop_m - session.tool_state().X_WP.p.z();
  ASSERT_GT(depth, 0.001);
  const double r = 0.0016, cone = r / std::tan(59 * std::numbers::pi / 180);
  const double wanted =
      std::numbers::pi * r * r * (std::max(0.0, depth - cone) + std::min(depth, cone) / 3) * 1e9;
  EXPECT_NEAR(removed_mm3(session), wanted, 0.1 * wanted + 0.3);
  EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kCutBegin; }));
  EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kCortexEntered; }));
  // Pulled sideways the wall holds it.
  HandInput aside = down_at(6000, 1);
  aside.input.X_WD.p.x() += 0.002;
  for (int i = 0; i < 400; ++i) (void)session.tick(std::span(&aside, 1));
  EXPECT_LT(std::abs(session.tool_state().X_WP.p.x() - 0.0003), 0.0004);
  EXPECT_LT(session.tool_state().force_W.x(), -1);
}

TEST(Carving, AStateGivesTheSameBitsAfterwards) {
  const Drilling with;
  Session session = with.session();
  run(session, 1, 2500, 1);
  ASSERT_GT(removed_mm3(session), 1);
  Session other = with.session();
  (void)go_on_as(other, session);
  run(session, 2501, 3500, 1);
  run(other, 2501, 3500, 1);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.tool_state().force_W, session.tool_state().force_W);
}

// Where the bytes of a changed state first differ, and how many words that field has.
struct Words {
  std::size_t at = 0, count = 0;
};
template <class Change>
Words words_of(SessionState state, std::size_t count, const Change& change) {
  const std::string before = to_bytes(state);
  CarvingState carved = *state.world.carved;
  change(state, carved);
  state.world.carved = std::make_shared<const CarvingState>(carved);
  const std::string after = to_bytes(state);
  const auto differ = std::mismatch(before.begin(), before.end(), after.begin());
  return {static_cast<std::size_t>(differ.first - before.begin()) / 8, count};
}

// Version 8 knew no holes that drills had left, no friction on soft parts, no water, no graft that
// is placed or ordered, no joint that is bent, no chatter, nothing that a scope had seen and no
// loose pieces.
TEST(Carving, AStateOfVersion8IsReadAndGoesOn) {
  Drilling with;
  with.settings.structures = false;  // as its recording's settings were
  Session session = with.session();
  run(session, 1, 2500, 1);
  const SessionState saved = session.save();
  ASSERT_TRUE(saved.world.carved);
  ASSERT_TRUE(saved.world.bones.guides[0].on) << "the hole that it has begun leads the drill";
  constexpr std::size_t kHoleWords = 14, kRubWords = 4, kChatterWords = 3;
  std::vector<Words> unknown = {
      words_of(saved, 5 + kPlacingNumbers,
               [](SessionState& s, CarvingState&) { s.world.bones.water.on = true; }),
      words_of(saved, 1,
               [](SessionState& s, CarvingState&) { s.world.bones.guides[0].pulls = true; }),
      words_of(saved, 1, [](SessionState& s, CarvingState&) { s.hands[0].watch.seen[0] = 1; }),
      words_of(saved, kRubWords,
               [](SessionState& s, CarvingState&) { s.hands[0].haptic.rub.lag_W.setConstant(1); }),
      words_of(saved, kHoleWords * saved.world.carved->holes.size(),
               [](SessionState&, CarvingState& c) { c.holes[0].bone = 3; })};
  const Inside in_bone{SubjectKind::kBone, 0, 1, 1, 0};
  for (std::size_t h = 0; h < kMaxHands; ++h)
    unknown.push_back(words_of(
        saved, 1, [&](SessionState& s, CarvingState&) { s.world.bones.inside[h][0] = in_bone; }));
  unknown.push_back(words_of(
      saved, 1, [&](SessionState& s, CarvingState&) { s.hands[0].watch.inside[0] = in_bone; }));
  // Of pieces the count stands first.
  unknown.push_back(words_of(saved, 1 + 2 * kMaxHands, [](SessionState&, CarvingState& c) {
    c.pieces.open[0] = !c.pieces.open[0];
  }));
  --unknown.back().at;
  for (std::size_t i = 0; i < saved.world.carved->hands.size(); ++i) {
    unknown.push_back(
        words_of(saved, 1, [i](SessionState&, CarvingState& c) { c.hands[i].loose = 1; }));
    unknown.push_back(words_of(saved, kChatterWords, [i](SessionState&, CarvingState& c) {
      c.hands[i].chatter.amplitude_m = 1;
    }));
  }
  std::sort(unknown.begin(), unknown.end(),
            [](const Words& a, const Words& b) { return a.at > b.at; });
  std::string old = to_bytes(saved);
  for (const Words& words : unknown) old.erase(8 * words.at, 8 * words.count);
  old[0] = 8;
  const auto back = state_from_bytes(old);
  ASSERT_TRUE(back) << back.error().message();
  Session other = with.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  run(session, 2501, 3000, 1);
  run(other, 2501, 3000, 1);
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

TEST(Carving, ARestorePointPutsTheBoneBack) {
  const Drilling with;
  Session session = with.session();
  HandInput mark = down_at(1, 0);
  mark.command = {CommandKind::kMark, 0};
  (void)session.tick(std::span(&mark, 1));
  run(session, 2, 3000, 1);
  ASSERT_GT(removed_mm3(session), 1);
  HandInput back = down_at(3000, 0);
  back.command = {CommandKind::kRestore, 0};
  (void)session.tick(std::span(&back, 1));
  HandInput above = down_at(0, 0);
  for (int i = 0; i < 200; ++i) (void)session.tick(std::span(&above, 1));
  EXPECT_EQ(removed_mm3(session), 0);
  // And it is felt whole again.
  run(session, 3, 1500, 0);
  EXPECT_GT(session.tool_state().X_WP.p.z(), kTop_m - 0.0002);
}

// A burr's origin is the middle of its ball.
TEST(Carving, ABurrRemovesWhereItIsPressed) {
  const Drilling with("microdrill:3");
  Session session = with.session();
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    HandInput hand = down_at(n, 0.5);
    hand.input.X_WD.p.z() += 0.0015;
    (void)session.tick(std::span(&hand, 1));
  }
  EXPECT_GT(removed_mm3(session), 3);
  EXPECT_LT(session.tool_state().X_WP.p.z(), kTop_m + 0.0005);
}

// As two threads do it: while the hand stands still physics goes on. It feels all that was cut when
// it goes on, and a replay gives the same bits.
TEST(Carving, AHandThatStoodStillFeelsAllAndReplays) {
  const Drilling with;
  Session session = with.session();
  Recording recording = begin_recording(with);
  ToolState tool;
  for (std::uint64_t n = 1; n <= 2600; ++n) {
    if (n < 1500 || n > 1900) {
      const HandInput hand = down_at(recording.ticks.size() + 1, 1);
      tool = session.haptic_tick(hand.input, session.bones(), hand.command);
      recording.ticks.push_back(session.last_tick_record());
    }
    if (n % 2 != 0) continue;
    (void)session.physics_step(tool);
    recording.steps.push_back(session.last_step_record());
  }
  recording.complete = true;
  ASSERT_GT(removed_mm3(session), 1);
  ReplayOptions options;
  options.tray = with.tray;
  options.carving = with.setup;
  const auto outcome = replay(recording, with.the_case, options);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
  EXPECT_EQ(outcome->state_hash, session.state_hash());
}

// A hand is given no snapshot whose cuts have not reached it, however narrow the way to it, and a
// replay feels the same.
TEST(Carving, AHandThatIsNotToldYetWaitsAndReplays) {
  Drilling with;
  with.with([](CarvingSetup& setup) { setup.channel_places = 40; });
  Session session = with.session();
  Recording recording = begin_recording(with);
  BoneSnapshot seen = session.bones();
  ToolState tool;
  bool was_behind = false;
  for (std::uint64_t n = 1; n <= 2600; ++n) {
    if (n < 1500 || n > 1900) {
      const HandInput hand = down_at(recording.ticks.size() + 1, 1);
      tool = session.haptic_tick(hand.input, seen, hand.command);
      recording.ticks.push_back(session.last_tick_record());
    }
    if (n % 2 != 0) continue;
    (void)session.physics_step(tool);
    recording.steps.push_back(session.last_step_record());
    was_behind = was_behind || !session.told(0);
    if (session.told(0)) seen = session.bones();
  }
  recording.complete = true;
  EXPECT_TRUE(was_behind);
  EXPECT_TRUE(session.told(0));
  ASSERT_GT(removed_mm3(session), 1);
  ReplayOptions options;
  options.tray = with.tray;
  options.carving = with.setup;
  const auto outcome = replay(recording, with.the_case, options);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
  EXPECT_EQ(outcome->state_hash, session.state_hash());
}

// Who draws gets every block, however rarely it reads, and the undo too.
TEST(Carving, WhoDrawsSeesTheCutsAsTheyAre) {
  const Drilling with;
  Session session = with.session();
  HandInput mark = down_at(1, 0);
  mark.command = {CommandKind::kMark, 0};
  (void)session.tick(std::span(&mark, 1));
  std::map<std::uint32_t, std::array<std::int16_t, CutsPatch::kNodes>> drawn;
  const auto read = [&] {
    CutsPatch patch;
    while (session.cuts_feed()->take(patch)) {
      if (patch.heat) continue;
      if (patch.clear)
        drawn.clear();
      else
        drawn[patch.block] = patch.cut;
    }
  };
  const auto expect_drawn = [&] {
    const CarvedField& field = *session.carving()->field(0);
    ASSERT_EQ(drawn.size(), field.block_count());
    for (const auto& [block, cut] : drawn)
      EXPECT_TRUE(std::equal(cut.begin(), cut.end(), field.cuts(block))) << block;
  };
  run(session, 2, 2500, 1);
  read();
  HandInput above = down_at(0, 0);
  for (int i = 0; i < 40; ++i) (void)session.tick(std::span(&above, 1));
  read();
  ASSERT_GT(drawn.size(), 5u);
  expect_drawn();
  HandInput back = down_at(0, 0);
  back.command = {CommandKind::kRestore, 0};
  (void)session.tick(std::span(&back, 1));
  for (int i = 0; i < 40; ++i) (void)session.tick(std::span(&above, 1));
  read();
  expect_drawn();
  EXPECT_TRUE(drawn.empty());
}

TEST(Carving, AFullPoolIsToldOnceAndNothingMoreIsRemoved) {
  Drilling with;
  with.with([](CarvingSetup& setup) { setup.most_blocks = 1; });
  Session session = with.session();
  std::vector<Event> events;
  run(session, 1, 2000, 1, &events);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kCarvingFull; }),
            1);
  EXPECT_EQ(removed_mm3(session), 0);
}

TEST(Carving, SettingsComeBackFromTheirText) {
  SessionSettings settings;
  settings.carve = {true, 0.0003, 0.002, 0.01, 12};
  const auto back = parse_settings(to_json(settings));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_TRUE(back->carve.on);
  EXPECT_EQ(back->carve.cell_m, 0.0003);
  EXPECT_EQ(back->carve.thrust_scale, 12);
  settings.carve.cell_m = -1;
  EXPECT_FALSE(parse_settings(to_json(settings)));
}

}  // namespace
}  // namespace osteon
