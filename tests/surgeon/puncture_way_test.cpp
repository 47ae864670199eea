#include "osteon/surgeon/puncture_surgeon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

constexpr double kPortalY_m = 0.0165;
const ScopeOptics kOblique{std::numbers::pi / 6, 0.9};

BoneDef cube(const char* name, const Vec3& middle) {
  BoneDef def;
  def.name = name;
  def.felt = Felt::kHull;
  def.X_WB.p = middle;
  for (int i = 0; i < 8; ++i)
    def.mesh.vertices.push_back(0.02 * Vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1));
  def.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return def;
}

// Skin at z = 0 over two bones with room between them; the trunk is at -x.
Case flat_knee(bool with_skin = true, bool closed = false) {
  CaseDef c;
  c.name = "flat knee";
  c.bones = {cube("femur", {-0.06, 0, -0.03}), cube("tibia", {0.06, 0, -0.03})};
  if (closed) c.bones[0] = cube("femur", {0, 0, -0.025});
  const Vec3 in = -Vec3::UnitZ();
  c.landmarks = {
      {"portal_al", {0, -kPortalY_m, 0}, in},    {"portal_am", {0, kPortalY_m, 0}, in},
      {"tibial_tubercle", {0.04, 0, -0.005}},    {"acl_femur", {-0.005, 0, -0.03}},
      {"acl_tibia", {0.005, 0, -0.035}},         {"blumensaat_posterior", {-0.02, 0, -0.05}},
      {"blumensaat_anterior", {-0.02, 0, -0.02}}};
  SoftDef skin;
  skin.name = skin.tissue = skin.kind = "skin";
  skin.mesh_W.vertices = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}};
  skin.mesh_W.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (with_skin) c.softs.push_back(skin);
  auto made = build_case(std::move(c));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

Skill fault(const std::string& name) {
  Skill skill = expert_skill();
  skill.name = "bad:" + name;
  return skill;
}

Result<PunctureWays> ways_of(const Case& the_case, const Skill& skill) {
  return plan_puncture(the_case, "arthroscope_30", kOblique, skill);
}

std::vector<std::string> taken(const ProbePath& path) {
  std::vector<std::string> out;
  for (const PathSample& sample : path.samples)
    if (out.empty() || out.back() != sample.instrument) out.push_back(sample.instrument);
  return out;
}

// Where a trocar is deepest the first or the last time that it is in the hand.
Vec3 deepest(const ProbePath& path, bool last) {
  Vec3 out = Vec3::UnitZ();
  bool in = false;
  for (const PathSample& sample : path.samples) {
    const bool now = sample.instrument == "trocar_blunt";
    if (now && !in && (last || out.z() > 0)) out = Vec3::UnitZ();
    if (in && !now && !last) return out;
    in = now;
    if (now && sample.X_WD.p.z() < out.z()) out = sample.X_WD.p;
  }
  return out;
}

TEST(PunctureWay, FailsWithoutSkinWithoutAWayInAndOnAnUnknownFault) {
  EXPECT_FALSE(ways_of(flat_knee(false), expert_skill()));
  const auto shut = ways_of(flat_knee(true, true), expert_skill());
  ASSERT_FALSE(shut);
  EXPECT_NE(shut.error().message().find("free"), std::string::npos);
  const auto unknown = ways_of(flat_knee(), fault("sneezed"));
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message().find("sneezed"), std::string::npos);
}

TEST(PunctureWay, TheExpertCutsGoesInLooksAndMakesTheSecondWhileTheScopeIsIn) {
  const auto ways = ways_of(flat_knee(), expert_skill());
  ASSERT_TRUE(ways) << ways.error().message();
  EXPECT_EQ(taken(ways->worker),
            (std::vector<std::string>{"scalpel_11", "trocar_blunt", "spinal_needle", "scalpel_11",
                                      "trocar_blunt", "hook_probe"}));
  EXPECT_EQ(taken(ways->scope), (std::vector<std::string>{"arthroscope_30"}));
  for (const ProbePath* path : {&ways->scope, &ways->worker})
    for (std::size_t i = 1; i < path->samples.size(); ++i)
      ASSERT_GT(path->samples[i].time_s, path->samples[i - 1].time_s) << i;
  EXPECT_LT(deepest(ways->worker, false).z(), -0.015);
  EXPECT_LT(deepest(ways->worker, true).z(), -0.015);
  // At the end the scope is within and looks at the other portal.
  const Pose end = ways->scope.samples.back().X_WD;
  EXPECT_LT(end.p.z(), -0.003);
  const ScopeView view = view_through(kOblique, end);
  EXPECT_GT(view.along_W.dot((Vec3(0, kPortalY_m, -0.003) - view.eye_W).normalized()), 0.9);
}

TEST(PunctureWay, EachFaultIsDone) {
  const Case c = flat_knee();
  const auto cut_at = [&](const std::string& name, bool last) {
    const auto ways = ways_of(c, fault(name));
    EXPECT_TRUE(ways) << name;
    Vec3 sum = Vec3::Zero();
    double count = 0;
    const double half = 0.5 * ways->worker.duration_s();
    for (const PathSample& sample : ways->worker.samples) {
      if (sample.instrument != "scalpel_11" || !(sample.X_WD.p.z() < -0.008)) continue;
      if ((sample.time_s > half) != last) continue;
      sum += sample.X_WD.p;
      ++count;
    }
    EXPECT_GT(count, 0) << name;
    return Vec3(sum / std::max(count, 1.0));
  };
  EXPECT_NEAR(cut_at("al_low", false).x(), 0.0085, 0.0015);
  EXPECT_NEAR(cut_at("al_midline", false).y(), -kPortalY_m + 0.0085, 0.0005);
  EXPECT_NEAR(cut_at("al_lateral", false).y(), -kPortalY_m - 0.0085, 0.0005);
  EXPECT_NEAR(cut_at("am_medial", true).y(), kPortalY_m + 0.0085, 0.0005);
  const auto forced = ways_of(c, fault("forced"));
  ASSERT_TRUE(forced);
  const Vec3 through = deepest(forced->worker, false);
  for (const PathSample& sample : forced->worker.samples)
    EXPECT_FALSE(sample.instrument == "scalpel_11" && sample.X_WD.p.z() < 0 &&
                 sample.X_WD.p.y() < 0);
  EXPECT_LT(through.z(), -0.025);
  const auto blind = ways_of(c, fault("am_blind"));
  ASSERT_TRUE(blind);
  EXPECT_GT(blind->scope.samples.back().X_WD.p.z(), 0.05);
  const auto plunged = ways_of(c, fault("plunged"));
  ASSERT_TRUE(plunged);
  // A centimetre and more into the femur, which ends at x = -0.04.
  double least = 1;
  for (const PathSample& sample : plunged->worker.samples)
    if (sample.instrument == "trocar_blunt") least = std::min(least, sample.X_WD.p.x());
  EXPECT_LT(least, -0.05);
}

TEST(PunctureWay, ABeginnerIsSlowerAndMissesALittle) {
  const auto expert = ways_of(flat_knee(), expert_skill()),
             novice = ways_of(flat_knee(), novice_skill(3));
  ASSERT_TRUE(expert && novice);
  EXPECT_GT(novice->worker.duration_s(), 1.2 * expert->worker.duration_s());
  EXPECT_GT((deepest(expert->worker, false) - deepest(novice->worker, false)).norm(), 2e-4);
}

}  // namespace
}  // namespace osteon
