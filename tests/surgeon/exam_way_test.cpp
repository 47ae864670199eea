#include "osteon/surgeon/exam_surgeon.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace osteon {
namespace {

TEST(ExamWay, LoadsTheKneeByBothTestsAndBendsItBack) {
  const KneeExamOrders exam = plan_knee_exam(3, 120, 110);
  ASSERT_FALSE(exam.orders.empty());
  EXPECT_GE(exam.orders.front().at_s, 3);
  EXPECT_TRUE(std::is_sorted(exam.orders.begin(), exam.orders.end(),
                             [](const auto& a, const auto& b) { return a.at_s < b.at_s; }));
  double bend = 120, pull = 0, pivot = 0, lachman_deg = -1, least = 200, most = 0;
  for (const TimedCommand& order : exam.orders) {
    const Command& said = order.command;
    if (said.kind == CommandKind::kBend) bend = said.value;
    if (said.kind == CommandKind::kLachman) pull = said.value;
    if (said.kind == CommandKind::kPivot) pivot = said.value;
    EXPECT_FALSE(pull > 0 && pivot > 0);
    if (pull > 0) lachman_deg = bend;
    if (pivot > 0) least = std::min(least, bend);
    if (pivot > 0) most = std::max(most, bend);
  }
  EXPECT_EQ(lachman_deg, 30);
  EXPECT_LE(least, 15);
  EXPECT_GE(most, 37);
  EXPECT_LE(most, 40);
  EXPECT_EQ(pull, 0);
  EXPECT_EQ(pivot, 0);
  EXPECT_EQ(bend, 110);
  EXPECT_GT(exam.end_s, exam.orders.back().at_s);
  EXPECT_LT(exam.end_s - 3, 15);
}

TEST(ExamWay, TheHandStaysWhereItIs) {
  const Pose at{Vec3(0.1, 0.2, 0.3), Quat::Identity()};
  const HandPart part = plan_exam_part("clamp", at, 30, 30);
  EXPECT_EQ(part.path.samples.front().instrument, "clamp");
  for (const PathSample& sample : part.path.samples) EXPECT_EQ(sample.X_WD.p, at.p);
  EXPECT_GE(part.path.duration_s(), part.orders.back().at_s);
}

}  // namespace
}  // namespace osteon
