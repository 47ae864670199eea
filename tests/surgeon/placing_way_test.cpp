#include <gtest/gtest.h>

#include <set>

#include "osteon/surgeon/placing_surgeon.h"
#include "placing_case.h"

namespace osteon {
namespace {

using testing::placing_knee;

Skill placing_fault(const std::string& name) {
  Skill skill = expert_skill();
  skill.name = "bad:" + name;
  return skill;
}

double farthest_x(const ProbePath& path, const std::string& instrument) {
  double most = -1;
  for (const PathSample& s : path.samples)
    if (s.instrument == instrument && s.jaw == 0 && std::abs(s.X_WD.p.y()) < 0.002)
      most = std::max(most, s.X_WD.p.x());
  return most;
}

TEST(PlacingWay, TakesPinGrasperAndClampInTurn) {
  const auto way = plan_graft_placing(*placing_knee(), expert_skill());
  ASSERT_TRUE(way);
  std::vector<std::string> taken;
  for (std::size_t i = 0; i < way->samples.size(); ++i) {
    if (i > 0) {
      ASSERT_GT(way->samples[i].time_s, way->samples[i - 1].time_s);
    }
    if (taken.empty() || taken.back() != way->samples[i].instrument)
      taken.push_back(way->samples[i].instrument);
  }
  EXPECT_EQ(taken, (std::vector<std::string>{"passing_pin", "grasper", "clamp"}));
  EXPECT_NEAR(farthest_x(*way, "passing_pin"), 0.062, 0.002);
}

TEST(PlacingWay, EachFaultChangesHowFarItGoes) {
  const auto drawn = [&](const std::string& fault) {
    const auto way =
        plan_graft_placing(*placing_knee(), fault.empty() ? expert_skill() : placing_fault(fault));
    EXPECT_TRUE(way) << fault;
    return way ? way->samples.back().X_WD.p.x() : 0;
  };
  const double good = drawn("");
  EXPECT_LT(drawn("unflipped_button"), good - 0.005);
  EXPECT_GT(drawn("soft_tissue"), good + 0.004);
  EXPECT_GT(drawn("flipped_in_muscle"), drawn("soft_tissue") + 0.008);
  const auto lost = plan_graft_placing(*placing_knee(), placing_fault("lost_thread"));
  ASSERT_TRUE(lost);
  EXPECT_GT(farthest_x(*lost, "passing_pin"), 0.095);
}

TEST(PlacingWay, AScopeStopsBeforeTheTunnelsMouths) {
  const auto way = plan_placing_scope(*placing_knee(), Vec3(-0.015, 0, 0.060), "arthroscope_30");
  ASSERT_TRUE(way);
  EXPECT_NEAR((way->samples.back().X_WD.p - Vec3(0, 0, -0.015)).norm(), 0.028, 1e-6);
}

TEST(PlacingWay, AnotherFaultOrACaseWithoutTunnelsIsRefused) {
  EXPECT_FALSE(plan_graft_placing(*placing_knee(), placing_fault("blow_out")));
  EXPECT_FALSE(plan_graft_placing(*testing::ring_box(), expert_skill()));
  EXPECT_FALSE(plan_placing_scope(*testing::ring_box(), Vec3::Zero(), "arthroscope_30"));
}

}  // namespace
}  // namespace osteon
