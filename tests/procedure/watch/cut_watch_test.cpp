#include "osteon/procedure/cut_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../report_fixtures.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// A plate of 20 x 24 x 1.6 mm whose edge at x = 0 shall go, 3 mm deep.
Case flat_plate() {
  CaseDef def;
  def.name = "plate";
  BoneDef bone;
  bone.name = "meniscus";
  for (int i = 0; i < 8; ++i)
    bone.mesh.vertices.push_back(
        Vec3((i & 1) ? 0.01 : -0.01, (i & 2) ? 0.012 : -0.012, (i & 4) ? 0.0008 : -0.0008));
  bone.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  bone.X_WB.p = {0.01, 0, 0};
  def.bones = {bone};
  def.landmarks = {{"e1", Vec3(0, -0.012, 0)}, {"e2", Vec3(0, 0.012, 0)}};
  auto made = build_case(std::move(def));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

constexpr double kBall_m = 0.0015;

struct Cutting {
  Cutting()
      : c(flat_plate()),
        watch(c, {0, {c.landmarks[0].p_W, c.landmarks[1].p_W}, 0.003}, kBall_m, 0, 0.001) {}
  void row(double x_mm) {
    for (double y = -14; y <= 14; y += 0.4) place(x_mm, y);
  }
  void place(double x_mm, double y_mm, double z_mm = 0) {
    tick += 10;
    watch.add(testing::tool_at(tick, Vec3(x_mm, y_mm, z_mm) / 1000), events);
  }
  Case c;
  CutWatch watch;
  std::vector<Event> events;
  std::uint64_t tick = 0;
};

TEST(CutWatch, SaysNothingOfABallThatTouches) {
  Cutting cut;
  EXPECT_NEAR(static_cast<double>(cut.watch.points()) * std::pow(CutWatch::kApart_m, 3),
              0.02 * 0.024 * 0.0016, 0.03 * 0.02 * 0.024 * 0.0016);
  cut.row(-1.5);
  cut.place(5, 0, 2.3);
  cut.place(std::nan(""), 0);
  EXPECT_TRUE(cut.events.empty());
}

// A ball drawn along the edge leaves the half of a cylinder's cross-section: a closed form.
TEST(CutWatch, ShareIsThatOfTheBallsWay) {
  Cutting cut;
  cut.row(0);
  ASSERT_FALSE(cut.events.empty());
  const double h = 0.0008, r = kBall_m - CutWatch::kTouch_m;
  const double area = h * std::sqrt(r * r - h * h) + r * r * std::asin(h / r);
  const auto& values = cut.events.back().values;
  EXPECT_NEAR(values[0], area / (0.003 * 2 * h), 0.06);
  EXPECT_EQ(values[1], 0);
  EXPECT_EQ(values[2], 0);
  EXPECT_EQ(cut.events.back().subject, 0u);
}

TEST(CutWatch, CutsBeyondThePartAreMeasured) {
  Cutting cut;
  for (const double x : {0.0, 1.0, 1.8}) cut.row(x);
  EXPECT_GT(cut.events.back().values[0], 0.97);
  EXPECT_LT(cut.events.back().values[2], 0.35);
  cut.place(3.5, 0);
  EXPECT_NEAR(cut.events.back().values[2], 0.5 + 1.45, 0.35);
  // A strip of 0.25 mm at most beyond the line, and the ball's round, of 17 x 24 mm.
  EXPECT_NEAR(cut.events.back().values[1], (0.25 * 24 + 3.14159 * 1.45 * 1.45) / (17 * 24), 0.008);
}

TEST(CutRules, ThePartMustGoAndTheRestStay) {
  const std::string text =
      "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
      "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\n"
      "rule = \"removed\"\nmarks = [\"e1\", \"e2\"]\nbones = [\"meniscus\"]\nshare = 0.9\n"
      "[[errors]]\nname = \"e\"\ntitle = \"E\"\nseverity = \"major\"\nconsequence = \"c\"\n"
      "source = \"D\"\nrule = \"cut_outside\"\nbeyond_mm = 1\n";
  Cutting cut;
  const auto scenario = parse_scenario(text, "w.toml");
  ASSERT_TRUE(scenario) << scenario.error().message();
  const auto plan = plan_scenario(*scenario, cut.c);
  ASSERT_TRUE(plan) << plan.error().message();
  ScenarioState state = begin_scenario(*plan);
  const auto judge_new = [&] {
    for (const Event& event : cut.events) judge(*plan, event, 0.001, state);
    cut.events.clear();
  };
  cut.row(0);
  judge_new();
  EXPECT_FALSE(state.over);
  cut.place(3.5, 0);
  cut.place(3.5, 1);
  judge_new();
  EXPECT_EQ(state.errors.size(), 1u);  // once, however often
  for (const double x : {1.0, 1.8}) cut.row(x);
  judge_new();
  EXPECT_TRUE(state.over);
  EXPECT_GT(state.completed_s[0], 0);
}

}  // namespace
}  // namespace osteon
