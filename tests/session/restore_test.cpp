// Going back: a state saved and restored, by a restore point, and from the middle of a recording.
#include <gtest/gtest.h>

#include <array>

#include "session_fixtures.h"
#include "two_hands.h"

namespace osteon {
namespace {

using testing::HandsAtRandom;
using testing::record_hands;
using testing::three_probes;
using testing::two_box_case;
using testing::two_hands;
using testing::with_three_probes;

std::uint64_t run_to(Session& session, HandsAtRandom& hands, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n <= to; ++n) (void)session.tick(hands.at(n));
  return session.state_hash();
}

// 200 random two-handed runs, each stopped at a random tick, its state taken into another session
// (through its bytes every second time), and both run on: the same bits to the end.
TEST(Restore, GivesTheSameBitsAfterwards) {
  const auto the_case = two_box_case();
  Session other(the_case, with_three_probes(), three_probes());
  Random random(11);
  for (int run = 0; run < 200; ++run) {
    Session session(the_case, with_three_probes(), three_probes());
    HandsAtRandom hands(static_cast<std::uint64_t>(run) + 100);
    const std::uint64_t stop = 1 + static_cast<std::uint64_t>(random.uniform(0, 250));
    const std::uint64_t end = stop + 1 + static_cast<std::uint64_t>(random.uniform(0, 150));
    const std::uint64_t hash = run_to(session, hands, 1, stop);
    const SessionState state = session.save();
    if (run % 2 == 0) {
      ASSERT_TRUE(other.restore(state));
    } else {
      const auto back = state_from_bytes(to_bytes(state));
      ASSERT_TRUE(back) << back.error().message();
      ASSERT_TRUE(other.restore(*back));
    }
    ASSERT_EQ(other.state_hash(), hash) << run;
    HandsAtRandom same = hands;
    ASSERT_EQ(run_to(session, hands, stop + 1, end), run_to(other, same, stop + 1, end)) << run;
  }
}

TEST(Restore, RefusesAStateOfAnotherSession) {
  const auto the_case = two_box_case();
  Session session(the_case, two_hands());
  Session alone(the_case, testing::moving_bones());
  EXPECT_FALSE(session.restore(alone.save()));
  SessionState odd = session.save();
  odd.hands[1].haptic.tool.instrument = 7;
  EXPECT_FALSE(session.restore(odd));
  odd = session.save();
  odd.hands[0].haptic.pairs.pop_back();
  EXPECT_FALSE(session.restore(odd));
}

TEST(Restore, RefusesDamagedBytes) {
  Session session(two_box_case(), two_hands());
  const std::string bytes = to_bytes(session.save());
  EXPECT_TRUE(state_from_bytes(bytes));
  EXPECT_FALSE(state_from_bytes(""));
  EXPECT_FALSE(state_from_bytes(bytes.substr(0, bytes.size() - 8)));
  EXPECT_FALSE(state_from_bytes(bytes + std::string(8, '\0')));
  std::string hands = bytes;
  hands[8] = 5;
  EXPECT_FALSE(state_from_bytes(hands));
}

// The bones go back; the force fades and rises again only after the hand has been free.
TEST(Restore, InContactRampsTheForce) {
  const auto the_case = two_box_case();
  SessionSettings settings = testing::moving_bones();
  Session session(the_case, settings);
  ToolInput input;
  input.X_WD.p = {0, 0, 0.010};
  const auto press_at = [&](double z, const Command& command = {}) {
    input.X_WD.p.z() = z;
    return session.tick(input, command).force_W.z();
  };
  for (int n = 0; n < 100; ++n) (void)press_at(0.010);
  const Pose start = session.bones().bones[0].X_WB;
  (void)press_at(0.010, {CommandKind::kMark, 3});
  (void)press_at(0.010);
  double force = 0;
  for (int n = 0; n < 500; ++n) force = press_at(0.010 - 0.00001 * n);
  ASSERT_GT(force, 2);
  ASSERT_GT((session.bones().bones[0].X_WB.p - start.p).norm(), 1e-4);
  double before = force;
  std::vector<double> after{press_at(0.005, {CommandKind::kRestore, 3})};
  for (int n = 0; n < 100; ++n) after.push_back(press_at(0.005));
  for (const double f : after) {
    EXPECT_LE(std::abs(f - before), force / 20 + 1e-9);  // zero after 20 ms at the earliest
    EXPECT_LE(f, before + 1e-9);
    before = f;
  }
  EXPECT_EQ(after.back(), 0);
  EXPECT_LT((session.bones().bones[0].X_WB.p - start.p).norm(), 1e-9);
  EXPECT_EQ(session.tool_state().epoch, 1u);
  EXPECT_EQ(session.bones().epoch, 1u);
  for (int n = 0; n < 300; ++n) (void)press_at(0.005 + 0.00001 * n);
  EXPECT_EQ(session.tool_state().force_W.norm(), 0);
  for (int n = 0; n < 300; ++n) force = press_at(0.008 - 0.00001 * n);
  EXPECT_GT(force, 1);
}

TEST(Restore, OfAMarkThatWasNotMadeDoesNothing) {
  const auto the_case = two_box_case();
  Session session(the_case, testing::moving_bones());
  (void)session.tick(testing::hand_at(1), {CommandKind::kRestore, 5});
  (void)session.tick(testing::hand_at(2), {CommandKind::kRestore, 99});
  (void)session.tick(testing::hand_at(3), {CommandKind::kMark, -1});
  EXPECT_EQ(session.tool_state().epoch, 0u);
  EXPECT_TRUE(session.last_events().empty());
}

TEST(Restore, BringsBackWhatTheHandsHeld) {
  const auto the_case = two_box_case();
  Session session(the_case, with_three_probes(), three_probes());
  const auto tick = [&](std::uint64_t n, const Command& left, const Command& right = {}) {
    const std::array<HandInput, 2> hands{HandInput{testing::hand_at(n), left},
                                         HandInput{testing::hand_at(n + 900), right}};
    (void)session.tick(hands);
  };
  tick(1, {CommandKind::kTake, 2});
  ASSERT_EQ(session.last_events(0).size(), 1u);
  EXPECT_EQ(session.last_events(0)[0].kind, EventKind::kInstrumentTaken);
  EXPECT_EQ(session.last_events(0)[0].subject, 2u);
  EXPECT_NEAR(session.last_events(0)[0].values[0], 3, 1e-12);  // mm across its tip
  tick(2, {CommandKind::kPower, 0.5});
  const Command mark{CommandKind::kMark, 0};
  tick(3, mark, mark);
  EXPECT_EQ(session.last_events(0)[0].kind, EventKind::kMark);
  EXPECT_TRUE(session.last_events(1).empty());
  tick(4, {CommandKind::kTake, 1}, {CommandKind::kTake, 2});
  EXPECT_EQ(session.tool(1).tip_radius_m, 0.0015);
  const Command back{CommandKind::kRestore, 0};
  tick(5, back, back);
  EXPECT_EQ(session.tool(0).tip_radius_m, 0.0015);
  EXPECT_EQ(session.tool(1).tip_radius_m, 0.00075);
  EXPECT_EQ(session.tool_state(0).power, 0.5);
  EXPECT_EQ(session.tool_state(0).tick, 5u);
}

TEST(Restore, AReplayFromTheMiddleGivesTheSameHashes) {
  const auto the_case = two_box_case();
  std::uint64_t hash = 0;
  const Recording recording = record_hands(the_case, 9, 4000, &hash, 250);
  for (const double from_s : {0.0, 0.25, 0.3, 1.999, 3.75, 99.0}) {
    ReplayOptions options;
    options.from_s = from_s;
    std::vector<Event> events;
    options.on_tick = [&](std::size_t, const ToolState&, const BoneSnapshot&,
                          std::span<const Event> some) {
      events.insert(events.end(), some.begin(), some.end());
    };
    const auto outcome = replay(recording, the_case, options);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
    EXPECT_EQ(outcome->state_hash, hash) << from_s;
    const auto begin = static_cast<std::uint64_t>(std::min(from_s, 4.0) * 1000) / 250 * 250;
    EXPECT_EQ(outcome->ticks, 4000 - begin);
    std::vector<Event> expected;
    for (const Event& event : recording.events)
      if (event.tick > begin) expected.push_back(event);
    EXPECT_EQ(events.size(), expected.size());
    EXPECT_TRUE(events == expected);
  }
}

}  // namespace
}  // namespace osteon
