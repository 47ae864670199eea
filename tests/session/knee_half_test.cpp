// A knee that is examined by hand in a session.
#include <gtest/gtest.h>

#include <limits>

#include "count_allocations.h"
#include "osteon/session/session.h"
#include "placing_case.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::go_on_as;

constexpr double kFull_n = 134, kFull_m = 0.012;

struct ExamSession {
  explicit ExamSession(std::optional<double> begin_deg = {}) {
    CaseDef def = testing::placing_def();
    testing::let_bend(def, begin_deg);
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built) << (built ? "" : built.error().message());
    the_case = std::make_shared<const Case>(std::move(*built));
    KneeGiveTable table;
    table.tibia = table.fibula = 1;
    table.front_n = kFull_n;
    table.valgus_nm = 10;
    table.internal_nm = 4;
    for (std::size_t t = 0; t < kKneeTests; ++t)
      for (auto& curve : table.gives[t])
        for (std::size_t k = 0; k < curve.size(); ++k) {
          const double share = static_cast<double>(k + 1) / KneeGiveTable::kShares;
          curve[k].way_B = share * (t == 0 ? Vec3(0, 0, kFull_m) : Vec3(0, 0.005, 0));
          curve[k].turn_B = t == 0 ? Vec3::Zero() : Vec3(share * Vec3(0.1, 0, 0));
          curve[k].front_m = share * (t == 0 ? kFull_m : 0.006);
          curve[k].other_front_m = share * 0.004;
        }
    numbers = give_numbers(table);
    recording.header = recording_header(*the_case, settings, "test", "0", {});
  }
  Session session() const { return Session(the_case, settings, {}); }
  // Told from tick 2 on, a number every second tick, to tick 662; at 30 degrees from tick 2000 on.
  HandInput hand(std::uint64_t n) const {
    HandInput hand;
    hand.input.X_WD = {Vec3(0.3, 0, 0), Quat::Identity()};
    if (n == 2) hand.command = {CommandKind::kKneeOrder, 0};
    const std::uint64_t k = n / 2 - 2;
    if (n % 2 == 0 && n >= 4 && k < numbers.size())
      hand.command = {CommandKind::kKneeNumber, numbers[k]};
    if (n == 1000) hand.command = {CommandKind::kBend, 30};
    if (n == 2000) hand.command = {CommandKind::kMark, 1};
    if (n == 2010) hand.command = {CommandKind::kLachman, kFull_n};
    if (n == 3000) hand.command = {CommandKind::kPivot, 0.5};
    return hand;
  }
  void tick(Session& session, const HandInput& hand) const {
    (void)session.tick(std::span(&hand, 1));
  }
  void run(Session& session, std::uint64_t from, std::uint64_t to) const {
    for (std::uint64_t n = from; n <= to; ++n) tick(session, hand(n));
  }
  // And a few steps.
  void say(Session& session, const Command& command, int ticks = 1200) const {
    HandInput one = hand(0);
    for (int n = 0; n < ticks; ++n) {
      one.command = n == 0 ? command : Command{};
      tick(session, one);
    }
  }
  SessionSettings settings;
  std::vector<double> numbers;
  std::shared_ptr<const Case> the_case;
  Recording recording;
};

const KneeExamState& exam_of(const Session& session) { return session.bones().exam; }
Pose tibia_of(const Session& session) { return session.bones().bones[1].X_WB; }

TEST(SessionExam, AKneeOfWhichNothingIsToldDoesNotGive) {
  const ExamSession rig;
  Session session = rig.session();
  const Pose before = tibia_of(session);
  rig.say(session, {CommandKind::kLachman, kFull_n});
  rig.say(session, {CommandKind::kKneeNumber, 3});
  rig.say(session, {CommandKind::kPivot, 1});
  EXPECT_FALSE(exam_of(session).on);
  EXPECT_EQ(tibia_of(session).p, before.p);
  EXPECT_FALSE(session.bones().bend.on);
}

TEST(SessionExam, AKneeThatBeginsOtherwiseBentStandsThereAndARestorePointKnowsIt) {
  const ExamSession rig(30), other;
  Session session = rig.session(), bent = other.session();
  other.say(bent, {CommandKind::kBend, 30});
  EXPECT_LT((tibia_of(session).p - tibia_of(bent).p).norm(), 1e-12);
  EXPECT_GT((tibia_of(session).p - other.session().bones().bones[1].X_WB.p).norm(), 1e-4);
  const Pose begun = tibia_of(session);
  rig.say(session, {CommandKind::kMark, 0}, 10);
  EXPECT_EQ(tibia_of(session).p, begun.p);
  EXPECT_EQ(session.bones().bend.now_deg, 30);
  rig.say(session, {CommandKind::kBend, 90});
  EXPECT_LT((tibia_of(session).p - rig.the_case->bones[1].X_WB.p).norm(), 1e-12);
  rig.say(session, {CommandKind::kRestore, 0});
  EXPECT_EQ(tibia_of(session).p, begun.p);
  EXPECT_EQ(session.bones().bend.wanted_deg, 30);
}

TEST(SessionExam, TheTibiaGoesAsTheTableSays) {
  const ExamSession rig;
  Session session = rig.session();
  rig.run(session, 1, 2009);
  ASSERT_TRUE(exam_of(session).on);
  EXPECT_NEAR(session.bones().bend.now_deg, 30, 1e-9);
  const Pose rest = tibia_of(session);
  rig.run(session, 2010, 2200);
  EXPECT_GT(exam_of(session).now[0], 0.2);
  EXPECT_LT(exam_of(session).now[0], 0.5);
  const std::size_t before = testing::allocations();
  rig.run(session, 2201, 2900);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_EQ(exam_of(session).now[0], 1);
  EXPECT_NEAR(exam_of(session).give.front_m, kFull_m, 1e-12);
  EXPECT_NEAR(exam_of(session).give.other_front_m, 0.004, 1e-12);
  const Pose& X_WF = session.bones().bones[0].X_WB;
  EXPECT_LT((tibia_of(session).p - rest.p - X_WF.rotate(Vec3(0, 0, kFull_m))).norm(), 1e-12);
  // The other test takes over.
  rig.run(session, 2901, 4200);
  EXPECT_EQ(exam_of(session).now[0], 0);
  EXPECT_EQ(exam_of(session).now[1], 0.5);
  EXPECT_NEAR(tibia_of(session).q.angularDistance(rest.q), 0.05, 1e-9);
  rig.say(session, {CommandKind::kPivot, 0});
  EXPECT_LT((tibia_of(session).p - rest.p).norm(), 1e-12);
}

TEST(SessionExam, IsLetGoWhereItIsBentTooFarAndHeedsNoFoolishLoad) {
  const ExamSession rig;
  Session session = rig.session();
  rig.run(session, 1, 2900);
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {none, std::numeric_limits<double>::infinity(), -1.0}) {
    rig.say(session, {CommandKind::kLachman, bad}, 4);
    rig.say(session, {CommandKind::kPivot, bad}, 4);
    EXPECT_EQ(exam_of(session).wanted[0], 1) << bad;
    EXPECT_EQ(exam_of(session).wanted[1], 0) << bad;
  }
  rig.say(session, {CommandKind::kLachman, 1e6}, 4);
  EXPECT_EQ(exam_of(session).wanted[0], 1);
  // It does not bend on before it is let go, nor jump.
  HandInput one = rig.hand(0);
  one.command = {CommandKind::kBend, 110};
  Pose was = tibia_of(session);
  bool waited = false;
  const double most_deg = KneeGiveTable::kMost_deg;
  for (int n = 0; n < 3000; ++n) {
    rig.tick(session, one);
    one.command = {};
    EXPECT_LT((tibia_of(session).p - was.p).norm(), 0.0003);
    was = tibia_of(session);
    waited = waited || (session.bones().bend.now_deg == most_deg && exam_of(session).now[0] > 0);
    EXPECT_TRUE(exam_of(session).now[0] == 0 || session.bones().bend.now_deg <= most_deg);
  }
  EXPECT_TRUE(waited);
  EXPECT_NEAR(session.bones().bend.now_deg, 110, 1e-9);
  rig.say(session, {CommandKind::kLachman, kFull_n});
  EXPECT_EQ(exam_of(session).now[0], 0);
}

TEST(SessionExam, NumbersThatAreNoTableTellNothing) {
  ExamSession rig;
  rig.numbers[40] = 1e9;
  Session session = rig.session();
  rig.run(session, 1, 2900);
  EXPECT_FALSE(exam_of(session).on);
  EXPECT_EQ(exam_of(session).now[0], 0);
  const auto read = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(read) << read.error().message();
  Session other = rig.session();
  EXPECT_TRUE(other.restore(*read));
}

TEST(SessionExam, RepeatsFromTheStartTheMiddleAndAMark) {
  ExamSession rig;
  Session session = rig.session();
  for (std::uint64_t n = 1; n <= 4000; ++n) {
    HandInput one = rig.hand(n);
    if (n == 2800) one.command = {CommandKind::kKneeOrder, 0};  // forgotten
    if (n == 2900) one.command = {CommandKind::kRestore, 1};    // and known again
    rig.tick(session, one);
    rig.recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) rig.recording.steps.push_back(session.last_step_record());
    if (n == 2850) {
      EXPECT_FALSE(exam_of(session).on);
    }
    if (n == 2950) {
      EXPECT_TRUE(exam_of(session).on);
    }
  }
  EXPECT_EQ(exam_of(session).now[1], 0.5);
  rig.recording.complete = true;
  const auto again = replay(rig.recording, rig.the_case, ReplayOptions{});
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
  for (const std::uint64_t stop : {300u, 2100u, 3100u}) {
    Session one = rig.session();
    rig.run(one, 1, stop);
    Session two = rig.session();
    const SessionState read = go_on_as(two, one);
    rig.run(one, stop + 1, 3500);
    rig.run(two, stop + 1, 3500);
    EXPECT_EQ(two.state_hash(), one.state_hash()) << stop;
    EXPECT_EQ(two.bones().bones[1].X_WB.p, one.bones().bones[1].X_WB.p);
    SessionState odd = read;
    odd.world.knee = nullptr;
    EXPECT_FALSE(two.restore(odd));
    odd = read;
    odd.world.bones.exam.now[0] = 2;
    EXPECT_FALSE(two.restore(odd));
  }
}

}  // namespace
}  // namespace osteon
