#include "osteon/scene/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

TriMesh boxed(const Vec3& half) {
  TriMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(Vec3((i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                              (i & 4) ? half.z() : -half.z()));
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

BoneDef bone(const std::string& name, const Vec3& half, const Vec3& p_W) {
  BoneDef def;
  def.name = name;
  def.mesh = boxed(half);
  def.X_WB.p = p_W;
  return def;
}

Case make(std::vector<BoneDef> bones) {
  CaseDef def;
  def.name = "boxes";
  def.bones = std::move(bones);
  auto made = build_case(std::move(def));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

// How far a point is outside a bone's planes; negative inside.
double outside(const Bone& b, const Vec3& p_W) {
  const Vec3 p_B = b.X_WB.inverse() * p_W;
  double worst = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : b.pieces[0].planes) worst = std::max(worst, plane.signed_distance(p_B));
  return worst;
}

TEST(Survey, AnEnclosedBoneIsNamedUnreachable) {
  std::vector<BoneDef> bones{bone("core", Vec3(0.005, 0.005, 0.005), Vec3::Zero())};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 half = Vec3::Constant(0.03);
      half[axis] = 0.001;
      Vec3 p = Vec3::Zero();
      p[axis] = side * 0.02;
      bones.push_back(bone("wall" + std::to_string(bones.size()), half, p));
    }
  const Survey s = make_survey(make(bones), make_wrist_probe(), {});
  EXPECT_EQ(s.unreachable, std::vector<std::string>{"core"});
  EXPECT_EQ(s.visited.size(), 6u);
}

TEST(Survey, PressesAsDeepAsTheForceNeeds) {
  const Case c = make({bone("block", Vec3(0.02, 0.01, 0.008), Vec3(0.1, 0, 0))});
  const Tool tool = make_wrist_probe();
  SurveyOptions options;
  const Survey s = make_survey(c, tool, options);
  ASSERT_EQ(s.visited, std::vector<std::string>{"block"});
  double deepest = 0;
  for (const PathSample& sample : s.path.samples)
    deepest = std::min(deepest, outside(c.bones[0], sample.X_WD.p) - tool.tip_radius_m);
  const double wanted = options.press_n / options.stiffness_n_per_m +
                        options.press_n / options.hand_stiffness_n_per_m;
  EXPECT_NEAR(-deepest, wanted, 1e-6);
}

TEST(Survey, StrokesTheWantedLength) {
  const Case c = make({bone("block", Vec3(0.03, 0.03, 0.008), Vec3::Zero())});
  const Tool tool = make_wrist_probe();
  const Survey s = make_survey(c, tool, {});
  Aabb pressed;
  for (const PathSample& sample : s.path.samples)
    if (outside(c.bones[0], sample.X_WD.p) < 0) pressed.include(sample.X_WD.p);
  EXPECT_NEAR(pressed.extent().norm(), SurveyOptions{}.stroke_m, 1.5e-3);
}

TEST(Survey, FreeMovementStaysClearOfEveryBone) {
  const Case c = make({bone("a", Vec3(0.02, 0.01, 0.01), Vec3(-0.03, 0, 0)),
                       bone("b", Vec3(0.02, 0.01, 0.01), Vec3(0.03, 0, 0.004)),
                       bone("c", Vec3(0.01, 0.03, 0.01), Vec3(0, 0.06, 0))});
  const Tool tool = make_wrist_probe();
  const Survey s = make_survey(c, tool, {});
  ASSERT_EQ(s.visited.size(), 3u);
  const double duration = s.path.duration_s();
  int touched_at_once = 0;
  for (double t = 0; t < duration; t += 0.002) {
    int touched = 0;
    for (const Bone& b : c.bones) touched += outside(b, s.path.at(t).X_WD.p) < tool.tip_radius_m;
    touched_at_once = std::max(touched_at_once, touched);
  }
  EXPECT_EQ(touched_at_once, 1);
}

TEST(Survey, TimesRiseAndTheHandIsNeverFasterThanATripLimit) {
  const Case c = make({bone("a", Vec3(0.02, 0.01, 0.01), Vec3(-0.03, 0, 0)),
                       bone("b", Vec3(0.02, 0.01, 0.01), Vec3(0.03, 0, 0))});
  const auto& samples = make_survey(c, make_wrist_probe(), {}).path.samples;
  ASSERT_GT(samples.size(), 20u);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt = samples[i].time_s - samples[i - 1].time_s;
    ASSERT_GT(dt, 0);
    ASSERT_LT((samples[i].X_WD.p - samples[i - 1].X_WD.p).norm() / dt, 0.5);
  }
}

TEST(Survey, IsAFunctionOfItsSeed) {
  const Case c = make({bone("a", Vec3(0.02, 0.01, 0.01), Vec3::Zero())});
  const Tool tool = make_wrist_probe();
  SurveyOptions one, two;
  two.seed = 2;
  const auto a = make_survey(c, tool, one).path.samples;
  const auto b = make_survey(c, tool, one).path.samples;
  const auto other = make_survey(c, tool, two).path.samples;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].X_WD.p, b[i].X_WD.p);
  EXPECT_NE(a[1].X_WD.p, other[1].X_WD.p);
}

}  // namespace
}  // namespace osteon
