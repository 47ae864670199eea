#include "osteon/surgeon/surgeon.h"

#include <gtest/gtest.h>

#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

BoneDef block(const std::string& name, const Vec3& half, const Vec3& p_W) {
  BoneDef def;
  def.name = name;
  for (int i = 0; i < 8; ++i)
    def.mesh.vertices.push_back(Vec3((i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                                     (i & 4) ? half.z() : -half.z()));
  def.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  def.X_WB.p = p_W;
  return def;
}

Case two_blocks() {
  CaseDef def;
  def.name = "blocks";
  def.bones = {block("a", {0.01, 0.01, 0.01}, {-0.02, 0, 0}),
               block("b", {0.01, 0.01, 0.01}, {0.02, 0, 0})};
  auto made = build_case(std::move(def));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

Scenario touch_two() {
  Scenario s;
  s.name = "two";
  s.where = "two.toml";
  ScenarioStage stage;
  stage.name = "only";
  stage.goals.push_back({"touched", {}, {{"for_s", 0.2}, {"force_n", 0.3}}, 1});
  s.stages.push_back(stage);
  ScenarioError hard;
  hard.name = "too_hard";
  hard.rule = {"pressed_over", {}, {{"force_n", 4}, {"for_s", 0.1}}, 2};
  s.errors.push_back(hard);
  return s;
}

TEST(Skill, IsReadFromItsName) {
  const Scenario s = touch_two();
  EXPECT_EQ(parse_skill(s, "expert")->name, "expert");
  EXPECT_EQ(parse_skill(s, "novice:7")->seed, 7u);
  EXPECT_EQ(parse_skill(s, "bad:too_hard")->fault, "pressed_over");
  for (const char* bad : {"", "export", "novice:", "novice:x", "bad:", "bad:nothing"})
    EXPECT_FALSE(parse_skill(s, bad)) << bad;
  EXPECT_EQ(surgeons_of(s), (std::vector<std::string>{"expert", "novice", "bad:too_hard"}));
}

TEST(Skill, WhoMissesFaultsCallsThemSoundAndWhoBlamesCallsSoundOnesFaulty) {
  Scenario s = touch_two();
  s.asks = {{"tunnel", "Tunnel", {"sound", "front"}, 0},
            {"socket", "Socket", {"sound", "steep"}, 0}};
  Case c = two_blocks();
  c.findings = {{"tunnel", "sound", ""}, {"socket", "steep", ""}};
  Skill skill = expert_skill();
  EXPECT_EQ(stated_by(skill, s, c), (StatedFindings{{"tunnel", "sound"}, {"socket", "steep"}}));
  skill.fault = "fault_missed";
  EXPECT_EQ(stated_by(skill, s, c), (StatedFindings{{"tunnel", "sound"}, {"socket", "sound"}}));
  skill.fault = "sound_blamed";
  EXPECT_EQ(stated_by(skill, s, c), (StatedFindings{{"tunnel", "front"}, {"socket", "steep"}}));
}

TEST(Skill, NovicesDifferFromEachOtherAndFromTheExpert) {
  EXPECT_NE(novice_skill(1).tremor_m, novice_skill(2).tremor_m);
  EXPECT_EQ(novice_skill(3).press_n, novice_skill(3).press_n);
  for (std::uint64_t seed = 1; seed < 20; ++seed)
    EXPECT_GT(novice_skill(seed).tremor_m, expert_skill().tremor_m);
}

TEST(Approach, GapIsTheDistanceToThePlanes) {
  const Case c = two_blocks();
  EXPECT_NEAR(gap_to(c.bones[0], {-0.02, 0, 0.015}), 0.005, 1e-9);
  EXPECT_NEAR(gap_to(c.bones[0], {-0.02, 0, 0.008}), -0.002, 1e-9);
}

TEST(Approach, LeadsOntoTheBoneAndPastTheOther) {
  const Case c = two_blocks();
  for (std::uint32_t bone = 0; bone < 2; ++bone) {
    const auto way = find_approach(c, bone, 0.00075, 1);
    ASSERT_TRUE(way);
    EXPECT_NEAR(gap_to(c.bones[bone], way->p_W), 0, 1e-6);
    for (double along = 0.001; along < 0.1; along += 0.001)
      EXPECT_GT(gap_to(c.bones[1 - bone], way->p_W + along * way->n_W), 0.00075);
  }
}

TEST(Approach, ThereIsNoneOntoABoneThatIsShutIn) {
  CaseDef def;
  def.name = "shut";
  def.bones = {block("core", {0.005, 0.005, 0.005}, Vec3::Zero())};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 half = Vec3::Constant(0.03), p = Vec3::Zero();
      half[axis] = 0.001;
      p[axis] = side * 0.02;
      def.bones.push_back(block("wall" + std::to_string(def.bones.size()), half, p));
    }
  auto c = build_case(std::move(def));
  ASSERT_TRUE(c);
  EXPECT_FALSE(find_approach(*c, 0, 0.00075, 1));
  EXPECT_TRUE(find_approach(*c, 1, 0.00075, 1));
}

// Against walls of 400 N/m at the bones' faces: it touches both as hard as it means to, and ends.
TEST(Surgeon, TouchesEveryBoneGentlyAndEnds) {
  const Case c = two_blocks();
  const auto plan = plan_scenario(touch_two(), c);
  ASSERT_TRUE(plan);
  Surgeon surgeon(*plan, c, expert_skill(), 0.00075);
  double peak_n[2] = {0, 0};
  int ticks = 0;
  for (; ticks < 60000 && !surgeon.done(); ++ticks) {
    const Pose wanted = surgeon.step(0.001);
    ASSERT_TRUE(is_finite(wanted));
    double force_n = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double depth = 0.00075 - gap_to(c.bones[i], wanted.p);
      if (depth > 0) force_n = 400 * depth;
      if (depth > 0) peak_n[i] = std::max(peak_n[i], force_n);
    }
    surgeon.feel({0, 0, force_n});
  }
  EXPECT_TRUE(surgeon.done());
  EXPECT_TRUE(surgeon.unreachable().empty());
  for (const double peak : peak_n) {
    EXPECT_GT(peak, 0.5);
    EXPECT_LT(peak, 3);
  }
}

}  // namespace
}  // namespace osteon
