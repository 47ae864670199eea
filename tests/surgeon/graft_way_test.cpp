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

TEST(GraftWay, AnotherFaultOrACaseWithoutABenchIsRefused) {
  EXPECT_FALSE(plan_graft(*bench_case(), graft_fault("blow_out")));
  EXPECT_FALSE(plan_graft(*testing::ring_box(), expert_skill()));
}

}  // namespace
}  // namespace osteon
