#include "osteon/procedure/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report_fixtures.h"

namespace osteon {
namespace {

using testing::named_case;
using testing::tool_at;
using testing::touch;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(ReportBuilder, OfNothingReportsNothing) {
  const Case the_case = named_case({"radius", "lunate"});
  const Report report = ReportBuilder(the_case).finish();
  EXPECT_EQ(report.case_name, "wrist");
  EXPECT_EQ(report.case_hash, 0xabcdefu);
  EXPECT_EQ(report.ticks, 0u);
  EXPECT_EQ(report.duration_s, 0);
  EXPECT_EQ(report.path_length_mm, 0);
  ASSERT_EQ(report.bones.size(), 2u);
  EXPECT_EQ(report.bones[1].name, "lunate");
  EXPECT_EQ(report.bones[1].first_contact_s, -1);
  EXPECT_EQ(report.bones[1].mean_force_n, 0);
}

TEST(ReportBuilder, OfACaseWithoutBonesStillMeasuresTheWay) {
  const Case the_case = named_case({});
  ReportBuilder builder(the_case);
  for (std::uint64_t n = 1; n <= 100; ++n) builder.add(tool_at(n, {1e-4 * double(n), 0, 0}));
  EXPECT_NEAR(builder.finish().path_length_mm, 9.9, 1e-9);
}

TEST(ReportBuilder, TalliesEachBone) {
  const Case the_case = named_case({"radius", "lunate", "hamate"});
  ReportBuilder builder(the_case);
  for (std::uint64_t n = 1; n <= 100; ++n) {
    ToolState tool = tool_at(n, Vec3::Zero());
    if (n >= 21 && n <= 40) touch(tool, 0, {0, 0, 0.1 * double(n - 20)}, 1e-5 * double(n - 20));
    if (n == 31 || n == 90) touch(tool, 1, {3, 4, 0}, 2e-3);
    builder.add(tool);
  }
  const Report report = builder.finish();
  EXPECT_EQ(report.ticks, 100u);
  EXPECT_NEAR(report.duration_s, 0.1, 1e-12);
  const BoneReport& radius = report.bones[0];
  EXPECT_NEAR(radius.first_contact_s, 0.021, 1e-12);
  EXPECT_NEAR(radius.contact_time_s, 0.020, 1e-12);
  EXPECT_NEAR(radius.peak_force_n, 2.0, 1e-12);
  EXPECT_NEAR(radius.mean_force_n, 1.05, 1e-12);
  EXPECT_NEAR(radius.deepest_mm, 0.2, 1e-12);
  const BoneReport& lunate = report.bones[1];
  EXPECT_NEAR(lunate.first_contact_s, 0.031, 1e-12);
  EXPECT_NEAR(lunate.contact_time_s, 0.002, 1e-12);
  EXPECT_NEAR(lunate.peak_force_n, 5, 1e-12);
  EXPECT_NEAR(lunate.mean_force_n, 5, 1e-12);
  EXPECT_NEAR(lunate.deepest_mm, 2, 1e-12);
  EXPECT_EQ(report.bones[2].first_contact_s, -1);
}

TEST(ReportBuilder, ForcesOfOneBoneAddUpAsVectors) {
  const Case the_case = named_case({"radius", "lunate"});
  ReportBuilder builder(the_case);
  ToolState tool = tool_at(1, Vec3::Zero());
  touch(tool, 0, {3, 0, 0}, 1e-3);
  touch(tool, 1, {1, 0, 0}, 0);
  touch(tool, 0, {-3, 0, 2}, 3e-3);
  builder.add(tool);
  const Report report = builder.finish();
  EXPECT_NEAR(report.bones[0].peak_force_n, 2, 1e-12);
  EXPECT_NEAR(report.bones[0].contact_time_s, 0.001, 1e-15);
  EXPECT_NEAR(report.bones[0].deepest_mm, 3, 1e-12);
  EXPECT_NEAR(report.bones[1].peak_force_n, 1, 1e-12);
}

TEST(ReportBuilder, IgnoresWhatCannotBe) {
  const Case the_case = named_case({"radius"});
  ReportBuilder builder(the_case);
  ToolState tool = tool_at(1, {kNaN, 0, 0});
  touch(tool, 7, {1, 0, 0}, 1);              // no such bone
  touch(tool, BoneId::kNone, {1, 0, 0}, 1);  // nor this
  touch(tool, 0, {kNaN, 0, 0}, kNaN);
  builder.add(tool);
  tool = tool_at(2, Vec3::Zero());
  tool.contact_count = 1000;  // more than there can be
  builder.add(tool);
  const Report report = builder.finish();
  EXPECT_EQ(report.bones[0].peak_force_n, 0);
  EXPECT_EQ(report.bones[0].deepest_mm, 0);
  EXPECT_TRUE(std::isfinite(report.path_length_mm));
}

TEST(ReportBuilder, TheWayIsThatOfTheProxyAt100Hz) {
  // A straight way with a tremor of 500 Hz on it: the tremor is not the way.
  const Case the_case = named_case({"radius"});
  ReportBuilder builder(the_case);
  for (std::uint64_t n = 1; n <= 1001; ++n)
    builder.add(tool_at(n, {2e-5 * double(n - 1), n % 2 == 0 ? 1e-3 : 0, 0}));
  EXPECT_NEAR(builder.finish().path_length_mm, 20, 1e-9);
}

TEST(ReportBuilder, TheWayHasItsEnd) {
  const Case the_case = named_case({"radius"});
  ReportBuilder builder(the_case);
  for (std::uint64_t n = 1; n <= 17; ++n) builder.add(tool_at(n, {1e-3 * double(n - 1), 0, 0}));
  EXPECT_NEAR(builder.finish().path_length_mm, 16, 1e-9);
}

TEST(ReportBuilder, AnotherTickKeepsTheRateOfTheWay) {
  const Case the_case = named_case({"radius"});
  ReportBuilder builder(the_case, 0.0005);
  for (std::uint64_t n = 1; n <= 2001; ++n)
    builder.add(tool_at(n, {1e-5 * double(n - 1), n % 20 == 1 ? 0 : 1e-3, 0}));
  EXPECT_NEAR(builder.finish().path_length_mm, 20, 1e-9);
  EXPECT_NEAR(builder.finish().duration_s, 1.0005, 1e-9);
}

TEST(ReportBuilder, SmoothnessIsThatOfTheSpeed) {
  // A minimum-jerk reach, clean and in jerks of 5 Hz.
  const Case the_case = named_case({"radius"});
  ReportBuilder clean(the_case), jerky(the_case);
  for (std::uint64_t n = 1; n <= 2000; ++n) {
    const double s = double(n) / 2000;
    const double x = s * s * s * (10 - 15 * s + 6 * s * s) * 0.1;
    clean.add(tool_at(n, {x, 0, 0}));
    jerky.add(tool_at(n, {x + 0.002 * std::sin(2 * 3.14159265 * 10 * s), 0, 0}));
  }
  EXPECT_LT(clean.finish().smoothness_sparc, -1);
  EXPECT_GT(clean.finish().smoothness_sparc, -2);
  EXPECT_LT(jerky.finish().smoothness_sparc, clean.finish().smoothness_sparc - 0.5);
}

Percentiles up_to_a_millisecond() {
  Percentiles durations;
  for (int i = 1; i <= 1000; ++i) durations.add_ns(i * 1000);
  return durations;
}

TEST(Report, TickTimesComeInMicroseconds) {
  const Percentiles durations = up_to_a_millisecond();
  Report report;
  set_tick_times(report, durations);
  EXPECT_NEAR(report.tick_p50_us, 500, 10);
  EXPECT_NEAR(report.tick_p99_us, 990, 20);
  EXPECT_NEAR(report.tick_p999_us, 999, 20);
  EXPECT_NEAR(report.tick_max_us, 1000, 1e-9);
  EXPECT_EQ(report.step_max_us, 0);
}

TEST(Report, StepTimesAreToldWhereTheyWereMeasured) {
  const Percentiles durations = up_to_a_millisecond();
  Report report;
  EXPECT_EQ(to_text(report).find("step time us"), std::string::npos);
  EXPECT_EQ(to_json(report).find("step_us"), std::string::npos);
  set_step_times(report, durations);
  EXPECT_NEAR(report.step_p50_us, 500, 10);
  EXPECT_NEAR(report.step_p99_us, 990, 20);
  EXPECT_NEAR(report.step_p999_us, 999, 20);
  EXPECT_NEAR(report.step_max_us, 1000, 1e-9);
  EXPECT_EQ(report.tick_max_us, 0);
  EXPECT_NE(to_text(report).find("max 1000.0 (physics)"), std::string::npos) << to_text(report);
  EXPECT_NE(to_json(report).find("step_us"), std::string::npos);
}

}  // namespace
}  // namespace osteon
