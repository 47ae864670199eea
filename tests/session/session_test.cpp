#include "osteon/session/session.h"

#include <gtest/gtest.h>

#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::command_at;
using testing::hand_at;
using testing::moving_bones;
using testing::two_box_case;

TEST(Session, BeginsAtRest) {
  const auto the_case = two_box_case();
  ASSERT_TRUE(the_case);
  Session session(the_case, {});
  EXPECT_EQ(session.last_tick_record().tick, 0u);
  EXPECT_EQ(session.last_step_record().step, 0u);
  EXPECT_EQ(session.bones().step, 0u);
  EXPECT_EQ(&session.the_case(), the_case.get());
  EXPECT_FALSE(session.tool().bodies.empty());
}

TEST(Session, RunsAStepEverySecondTick) {
  Session session(two_box_case(), moving_bones());
  for (std::uint64_t n = 1; n <= 100; ++n) {
    const ToolState& tool = session.tick(hand_at(n));
    EXPECT_EQ(tool.tick, n);
    EXPECT_EQ(session.last_steps(), n % 2 == 0 ? 1 : 0);
    EXPECT_EQ(session.bones().step, n / 2);
    const TickRecord& record = session.last_tick_record();
    EXPECT_EQ(record.tick, n);
    EXPECT_EQ(record.bone_step, (n - 1) / 2);
    EXPECT_EQ(record.force_W, tool.force_W);
    EXPECT_EQ(record.p_WP, tool.X_WP.p);
    EXPECT_EQ(record.input.X_WD.p, hand_at(n).X_WD.p);
    EXPECT_EQ(record.state_hash != 0, n % kHashInterval == 0);
    if (n % 2 == 0) {
      EXPECT_EQ(session.last_step_record().tool_ticks[0], n);
    }
  }
}

TEST(Session, TheHandFeelsTheBoneAndTheBoneYields) {
  Session session(two_box_case(), moving_bones());
  double force_n = 0, shift_m = 0;
  for (std::uint64_t n = 1; n <= 350; ++n) {
    force_n = std::max(force_n, session.tick(hand_at(n)).force_W.z());
    shift_m = std::max(shift_m, -session.bones().bones[0].X_WB.p.z());
  }
  EXPECT_GT(force_n, 1.0);
  EXPECT_GT(shift_m, 1e-4);  // pushed down
  EXPECT_LT(shift_m, 5e-3);
  EXPECT_EQ(session.bones().bones[1].X_WB.p, session.the_case().bones[1].X_WB.p);
}

TEST(Session, IsAFunctionOfItsInputs) {
  const auto the_case = two_box_case();
  Session a(the_case, moving_bones()), b(the_case, moving_bones());
  for (std::uint64_t n = 1; n <= 1200; ++n) {
    (void)a.tick(hand_at(n), command_at(n));
    (void)b.tick(hand_at(n), command_at(n));
    ASSERT_EQ(a.state_hash(), b.state_hash()) << n;
  }
}

TEST(Session, TheHashSeesTheInput) {
  const auto the_case = two_box_case();
  Session a(the_case, moving_bones()), b(the_case, moving_bones());
  for (std::uint64_t n = 1; n <= 300; ++n) {
    ToolInput other = hand_at(n);
    if (n == 290) other.X_WD.p.z() += 1e-9;
    (void)a.tick(hand_at(n));
    (void)b.tick(other);
    EXPECT_EQ(a.state_hash() == b.state_hash(), n < 290) << n;
  }
  EXPECT_NE(a.last_tick_record().state_hash, b.last_tick_record().state_hash);
}

TEST(Session, CommandsActAtTheirEdge) {
  const auto the_case = two_box_case();
  Session session(the_case, moving_bones());
  for (std::uint64_t n = 1; n <= 350; ++n) (void)session.tick(hand_at(n));
  // Tick 351 is odd: the bones are held at the step after tick 352.
  (void)session.tick(hand_at(351), {CommandKind::kHoldBones, 1});
  EXPECT_EQ(session.last_tick_record().command.kind, CommandKind::kHoldBones);
  EXPECT_NE(session.bones().bones[0].X_WB.p, the_case->bones[0].X_WB.p);
  (void)session.tick(hand_at(352));
  EXPECT_EQ(session.last_step_record().command.kind, CommandKind::kHoldBones);
  EXPECT_EQ(session.bones().bones[0].X_WB.p, the_case->bones[0].X_WB.p);
  (void)session.tick(hand_at(353));
  (void)session.tick(hand_at(354));
  EXPECT_EQ(session.last_step_record().command.kind, CommandKind::kNone);

  for (std::uint64_t n = 355; n <= 400; ++n)
    (void)session.tick(hand_at(n), n == 355 ? Command{CommandKind::kForceOff, 1} : Command{});
  EXPECT_EQ(session.last_tick_record().force_W, Vec3::Zero());
}

TEST(Session, MayBeMoved) {
  const auto the_case = two_box_case();
  Session a(the_case, moving_bones());
  for (std::uint64_t n = 1; n <= 100; ++n) (void)a.tick(hand_at(n));
  const std::uint64_t hash = a.state_hash();
  Session b(std::move(a));
  EXPECT_EQ(b.state_hash(), hash);
  EXPECT_EQ(b.tick(hand_at(101)).tick, 101u);
}

TEST(RecordingHeader, NamesCaseAndSettings) {
  const auto the_case = two_box_case();
  const RecordingHeader header = recording_header(*the_case, moving_bones(), "folder", "1.2");
  EXPECT_EQ(header.case_name, "two boxes");
  EXPECT_EQ(header.case_source, "folder");
  EXPECT_EQ(header.case_hash, the_case->hash);
  EXPECT_EQ(header.seed, 42u);
  EXPECT_EQ(header.settings_json, to_json(moving_bones()));
  EXPECT_EQ(header.osteon_version, "1.2");
}

}  // namespace
}  // namespace osteon
