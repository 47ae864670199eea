#include <gtest/gtest.h>

#include <set>

#include "graft_bench_case.h"
#include "osteon/surgeon/graft_surgeon.h"

namespace osteon {
namespace {

using testing::bench_case;

Skill graft_fault(const std::string& name) {
  Skill skill = expert_skill();
  skill.name = "bad:" + name;
  return skill;
}

std::set<std::pair<std::string, double>> taken(const ProbePath& path) {
  std::set<std::pair<std::string, double>> out;
  for (const PathSample& sample : path.samples) out.insert({sample.instrument, sample.size_mm});
  return out;
}

TEST(GraftWay, TakesTheSizersAboutTheGraftAndTheLoopThatFits) {
  const auto way = plan_graft(*bench_case(), expert_skill());
  ASSERT_TRUE(way);
  for (std::size_t i = 1; i < way->samples.size(); ++i)
    ASSERT_GT(way->samples[i].time_s, way->samples[i - 1].time_s);
  const auto tools = taken(*way);
  EXPECT_TRUE(tools.contains({"graft_sizer", 8.0}));
  EXPECT_TRUE(tools.contains({"graft_sizer", 7.5}));
  EXPECT_TRUE(tools.contains({"endobutton", 20.0}));
  EXPECT_TRUE(tools.contains({"tendon_stripper", 0.0}));
}

TEST(GraftWay, EachFaultChangesWhatItNames) {
  const auto good = plan_graft(*bench_case(), expert_skill());
  const auto stuck = plan_graft(*bench_case(), graft_fault("unflipped_button"));
  const auto loose = plan_graft(*bench_case(), graft_fault("long_loop"));
  const auto hasty = plan_graft(*bench_case(), graft_fault("slack_graft"));
  const auto forgets = plan_graft(*bench_case(), graft_fault("amputated_tendon"));
  ASSERT_TRUE(good && stuck && loose && hasty && forgets);
  EXPECT_TRUE(taken(*stuck).contains({"endobutton", 15.0}));
  EXPECT_TRUE(taken(*loose).contains({"endobutton", 30.0}));
  EXPECT_LT(hasty->duration_s(), good->duration_s() - 20);
  EXPECT_LT(forgets->duration_s(), good->duration_s());
}

std::size_t shut_with(const ProbePath& path, const std::string& instrument) {
  std::size_t shut = 0;
  for (std::size_t i = 1; i < path.samples.size(); ++i)
    if (path.samples[i].instrument == instrument && path.samples[i].jaw == 0 &&
        path.samples[i - 1].jaw == 1)
      ++shut;
  return shut;
}

// Where fascia covers them.
TEST(GraftWay, OpensTheFasciaAndLiftsBothTendonsOrHurtsWhatLiesByIt) {
  const auto covered = bench_case(testing::covered_bench_def());
  const auto bare = plan_graft(*bench_case(), expert_skill());
  const auto good = plan_graft(*covered, expert_skill());
  const auto deep = plan_graft(*covered, graft_fault("mcl_cut"));
  const auto beside = plan_graft(*covered, graft_fault("nerve_cut"));
  ASSERT_TRUE(bare && good && deep && beside);
  // Jaws shut on each tendon once more, and once to close after it.
  EXPECT_EQ(shut_with(*good, "clamp"), shut_with(*bare, "clamp") + 4);
  const auto least = [](const ProbePath& path, int axis) {
    double out = 1;
    for (const PathSample& sample : path.samples)
      if (sample.time_s < 15) out = std::min(out, sample.X_WD.p[axis]);
    return out;
  };
  EXPECT_LT(least(*deep, 2), least(*good, 2) - 0.006);
  const auto drawn_behind = [](const ProbePath& path) {
    for (const PathSample& sample : path.samples)
      if (sample.X_WD.p.z() < 0 && sample.X_WD.p.x() > 0.03 && sample.X_WD.p.x() < 0.045 &&
          sample.X_WD.p.y() < -0.018 && sample.X_WD.p.y() > -0.030)
        return true;
    return false;
  };
  EXPECT_TRUE(drawn_behind(*beside));
  EXPECT_FALSE(drawn_behind(*good));
}

TEST(GraftWay, ScrapesAndStitchesBothTendonsOrForgetsTo) {
  const auto good = plan_graft(*bench_case(), expert_skill());
  const auto dirty = plan_graft(*bench_case(), graft_fault("muscle_left"));
  const auto loose = plan_graft(*bench_case(), graft_fault("few_stitches"));
  ASSERT_TRUE(good && dirty && loose);
  EXPECT_LT(dirty->duration_s(), good->duration_s());
  // Each pass, and the jaws once more at the end of each tendon.
  EXPECT_EQ(shut_with(*good, "needle_holder"), 2 * 5u + 2);
  EXPECT_EQ(shut_with(*loose, "needle_holder"), 2 * 2u + 2);
  // The graft that has muscle on it measures thicker.
  EXPECT_FALSE(taken(*dirty).contains({"graft_sizer", 7.5}));
}

// From and back to where the hand is held, with what it held.
TEST(GraftWay, TheStageOfAReconstructionBeginsAndEndsAtTheKnee) {
  const Pose from{Vec3(0.05, -0.02, -0.04), Quat::Identity()};
  const auto way = plan_graft_stage(*bench_case(), expert_skill(), 20, from, "guide_pin");
  ASSERT_TRUE(way);
  EXPECT_EQ(way->samples.front().instrument, "guide_pin");
  EXPECT_EQ(way->samples.back().instrument, "guide_pin");
  EXPECT_LT((way->samples.front().X_WD.p - from.p).norm(), 1e-3);
  EXPECT_LT((way->samples.back().X_WD.p - from.p).norm(), 1e-3);
  for (std::size_t i = 1; i < way->samples.size(); ++i)
    ASSERT_GT(way->samples[i].time_s, way->samples[i - 1].time_s);
  EXPECT_FALSE(taken(*way).contains({"endobutton", 20.0}));  // once the channel is known
  const auto hung = plan_loop_stage(*bench_case(), expert_skill(), 0.040, 0.026, from, "guide_pin");
  const auto tight =
      plan_loop_stage(*bench_case(), graft_fault("short_loop"), 0.040, 0.026, from, "guide_pin");
  ASSERT_TRUE(hung && tight);
  EXPECT_TRUE(taken(*hung).contains({"endobutton", 20.0}));
  EXPECT_TRUE(taken(*tight).contains({"endobutton", 15.0}));
  EXPECT_FALSE(plan_loop_stage(*bench_case(), expert_skill(), 0.2, 0.026, from, "guide_pin"));
  EXPECT_NEAR(drilled_for_graft(*bench_case(), expert_skill()).value(), 0.008, 1e-9);
  EXPECT_GT(drilled_for_graft(*bench_case(), graft_fault("wide_tunnel")).value(), 0.0085);
}

TEST(GraftWay, AnotherFaultOrACaseWithoutABenchIsRefused) {
  EXPECT_FALSE(plan_graft(*bench_case(), graft_fault("blow_out")));
  EXPECT_FALSE(plan_graft(*testing::ring_box(), expert_skill()));
}

}  // namespace
}  // namespace osteon
