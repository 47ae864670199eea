#include "exercises/exam_order.h"

#include <gtest/gtest.h>

#include "cases/open_case.h"
#include "runs/reports/acl_report.h"

namespace osteon {
namespace {

// What the order tells, as a session takes it.
struct ToldExam {
  explicit ToldExam(const std::string& spec)
      : spec_of_knee(spec), the_case(*open_case(spec, {}, CaseParts::kFelt)) {}
  std::vector<double> numbers(ExamOrder& order, const std::optional<KneeGraft>& fixed) {
    order.see(fixed, bones);
    order.see(fixed, bones);  // computed by the first
    std::vector<double> out;
    const auto first = order.take();
    if (!first) return out;
    EXPECT_EQ(first->kind, CommandKind::kKneeOrder);
    bones.exam.told = 1;
    bones.exam.digest = 0;
    for (auto next = order.take(); next && out.size() < kKneeGiveNumbers; next = order.take()) {
      EXPECT_EQ(next->kind, CommandKind::kKneeNumber);
      out.push_back(next->value);
      // Pictures are slow, and show nothing of it yet: it is not told anew for all that.
      bones.time_s += 0.1;
      order.see(fixed, bones);
    }
    EXPECT_FALSE(order.take());
    bones.time_s += 2;
    bones.exam.told = static_cast<std::uint32_t>(out.size());
    bones.exam.digest = give_digest(out);
    return out;
  }
  std::string spec_of_knee;
  std::shared_ptr<const Case> the_case;
  BoneSnapshot bones;
};

// By the mechanics of `osteon case laxity` at its bends; between them nearly.
void expect_as_tested(const KneeGiveTable& table, const CaseDef& def, const KneeChanges& changes) {
  const auto ligaments = shipped_ligaments();
  ASSERT_TRUE(ligaments);
  const auto knee = make_knee(def, *ligaments, changes);
  ASSERT_TRUE(knee) << knee.error().message();
  for (LaxityTestRow row : ligaments->tests) {
    if (row.name != "lachman" && row.name != "pivot") continue;
    const KneeTest test = row.name == "lachman" ? KneeTest::kLachman : KneeTest::kPivot;
    for (const double deg : {0.0, row.flexion_deg, 40.0}) {
      row.flexion_deg = deg;
      const auto found = test_laxity(*knee, row);
      ASSERT_TRUE(found);
      const auto give = give_at(table, test, deg, 1);
      ASSERT_TRUE(give);
      EXPECT_NEAR(give->front_m, found->anterior_m, 1e-12) << row.name << deg;
      const Vec3 front = front_F(found->rest.flexion_rad);
      const Vec3 way(give->way_B.x(), def.side == "left" ? -give->way_B.y() : give->way_B.y(),
                     give->way_B.z());
      EXPECT_NEAR(front.dot(way), found->anterior_m, 1e-9);
    }
    row.flexion_deg = 25;
    row.anterior_n *= 0.6;
    row.varus_nm *= 0.6;
    row.internal_nm *= 0.6;
    const auto between = test_laxity(*knee, row);
    ASSERT_TRUE(between);
    EXPECT_NEAR(give_at(table, test, 25, 0.6)->front_m, between->anterior_m, 0.0006) << row.name;
  }
}

class ExamOrderOfKnees : public ::testing::TestWithParam<const char*> {};

TEST_P(ExamOrderOfKnees, TellsTheKneeTornAndWithItsGraft) {
  const std::string spec = "builtin:knee:1:" + std::string(GetParam()) + "acl_tear=midsubstance";
  ToldExam rig(spec);
  const auto def = open_case_def(spec);
  ASSERT_TRUE(def) << def.error().message();
  ExamOrder order(*rig.the_case, spec, false);
  const auto torn = rig.numbers(order, std::nullopt);
  ASSERT_FALSE(order.problem()) << order.problem()->message();
  const auto torn_table = give_of_numbers(*rig.the_case, torn);
  ASSERT_TRUE(torn_table);
  EXPECT_EQ(torn_table->knee, 0u);
  EXPECT_EQ(torn_table->tibia, rig.the_case->find("tibia").index);
  expect_as_tested(*torn_table, *def, {});
  KneeChanges healed;
  healed.heal = true;
  KneeGiveTable intact = *torn_table;
  for (auto& test : intact.gives)
    for (auto& curve : test)
      for (KneeGive& give : curve) give.front_m = give.other_front_m;
  const auto ligaments = shipped_ligaments();
  const auto whole = make_knee(*def, *ligaments, healed);
  for (const LaxityTestRow& row : ligaments->tests)
    if (row.name == "lachman") {
      EXPECT_NEAR(give_at(intact, KneeTest::kLachman, row.flexion_deg, 1)->front_m,
                  test_laxity(*whole, row)->anterior_m, 1e-12);
    }
  // What has come is not told again; with a graft it is another knee.
  EXPECT_TRUE(rig.numbers(order, std::nullopt).empty());
  const KneeGraft graft{};
  const auto held = rig.numbers(order, graft);
  const auto held_table = give_of_numbers(*rig.the_case, held);
  ASSERT_TRUE(held_table);
  EXPECT_EQ(held_table->knee, 1u);
  KneeChanges changes;
  changes.graft = graft;
  expect_as_tested(*held_table, *def, changes);
  const auto at = [](const KneeGiveTable& t) {
    return give_at(t, KneeTest::kLachman, 30, 1)->front_m;
  };
  EXPECT_GT(at(*torn_table), at(*held_table) + 0.006);
  EXPECT_TRUE(rig.numbers(order, graft).empty());
  // Back before the graft, whatever the session knows.
  EXPECT_EQ(rig.numbers(order, std::nullopt), torn);
  // Not while hands load it.
  rig.bones.exam.now[0] = 0.2;
  EXPECT_TRUE(rig.numbers(order, graft).empty());
  rig.bones.exam.now[0] = 0;
  EXPECT_EQ(rig.numbers(order, graft), held);
}

INSTANTIATE_TEST_SUITE_P(BothSides, ExamOrderOfKnees, ::testing::Values("", "left:"),
                         [](const auto& side) {
                           return std::string(side.param).empty() ? "right" : "left";
                         });

TEST(ExamOrders, SayWhyAKneeCannotBeExamined) {
  ToldExam rig("builtin:wrist");
  ExamOrder order(*rig.the_case, "builtin:wrist", false);
  EXPECT_TRUE(rig.numbers(order, std::nullopt).empty());
  EXPECT_TRUE(order.problem());
}

}  // namespace
}  // namespace osteon
