#include "osteon/anatomy/name_bones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "osteon/anatomy/generate.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(Assignment, AgreesWithTryingEveryOrder) {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    std::vector<std::vector<double>> cost(4, std::vector<double>(6));
    for (auto& row : cost)
      for (double& c : row) c = random.uniform();
    const std::vector<int> found = least_cost_assignment(cost);
    std::vector<int> order(6);
    std::iota(order.begin(), order.end(), 0);
    double best = 1e9, got = 0;
    do {
      double sum = 0;
      for (std::size_t r = 0; r < 4; ++r) sum += cost[r][static_cast<std::size_t>(order[r])];
      best = std::min(best, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    for (std::size_t r = 0; r < 4; ++r) got += cost[r][static_cast<std::size_t>(found[r])];
    EXPECT_NEAR(got, best, 1e-12);
  }
  EXPECT_TRUE(least_cost_assignment({}).empty());
}

const std::vector<ModelBone>& model_wrist() {
  static const std::vector<ModelBone> bones = [] {
    GenerateOptions coarse;
    coarse.cell_m = 0.0016;
    coarse.soft_parts = false;
    const auto anatomy =
        generate_anatomy(std::string(OSTEON_SOURCE_DIR) + "/assets/anatomy/wrist.toml", coarse);
    std::vector<ModelBone> out;
    for (const GeneratedBone& bone : anatomy->bones) {
      ModelBone points{bone.name, {}};
      for (std::size_t n = 0; n < bone.mesh.vertices.size(); n += 5)
        points.points_M.push_back(bone.X_WB * bone.mesh.vertices[n]);
      out.push_back(std::move(points));
    }
    return out;
  }();
  return bones;
}

/// The wrist as another patient's, in some position; regions in another order.
std::vector<std::vector<Vec3>> regions(bool left, std::uint64_t seed, std::vector<int>& truth) {
  Random random(seed);
  const Quat q = random.rotation();
  const Vec3 t = 0.3 * random.direction();
  std::vector<std::vector<Vec3>> out;
  truth.clear();
  for (std::size_t n = 0; n < model_wrist().size(); ++n) {
    const std::size_t b = (n * 7 + 3) % model_wrist().size();
    truth.push_back(static_cast<int>(b));
    out.emplace_back();
    for (const Vec3& p : model_wrist()[b].points_M) {
      const Vec3 jitter = random.direction() * 0.0003;
      const Vec3 s(1.08 * p.x(), (left ? -0.95 : 0.95) * p.y(), 1.03 * p.z() + 0.05 * p.y());
      out.back().push_back(q * (s + jitter) + t);
    }
  }
  return out;
}

TEST(NameBones, EitherHandInAnyPosition) {
  for (const bool left : {false, true}) {
    std::vector<int> truth;
    const auto scan = regions(left, left ? 5 : 6, truth);
    const BoneNames names = name_bones(model_wrist(), scan);
    ASSERT_TRUE(names.recognised());
    EXPECT_EQ(names.fit.mirrored, left);
    EXPECT_EQ(names.bone_of_region, truth);
    const Vec3 p_M(0.01, 0.02, -0.005);
    EXPECT_LT((names.fit.to_model(names.fit.to_patient(p_M)) - p_M).norm(), 1e-12);
  }
}

TEST(NameBones, BonesThatHaveGrownTogetherAreListed) {
  std::vector<int> truth;
  auto scan = regions(false, 8, truth);
  const auto find = [&](const std::string& name) {
    for (std::size_t r = 0; r < truth.size(); ++r)
      if (model_wrist()[static_cast<std::size_t>(truth[r])].name == name) return r;
    return truth.size();
  };
  const std::size_t capitate = find("capitate"), hamate = find("hamate");
  std::vector<int> both = {truth[capitate], truth[hamate]};
  std::sort(both.begin(), both.end());
  scan[capitate].insert(scan[capitate].end(), scan[hamate].begin(), scan[hamate].end());
  scan[hamate].clear();
  const BoneNames names = name_bones(model_wrist(), scan);
  ASSERT_TRUE(names.recognised());
  EXPECT_EQ(names.bones_in_region[capitate], both);
}

TEST(NameBones, SomethingElseIsNotRecognised) {
  Random random(4);
  std::vector<std::vector<Vec3>> balls(3);
  for (std::size_t b = 0; b < 3; ++b)
    for (int n = 0; n < 200; ++n)
      balls[b].push_back(Vec3(0.15 * static_cast<double>(b), 0, 0) + 0.06 * random.direction());
  const BoneNames names = name_bones(model_wrist(), balls);
  EXPECT_FALSE(names.recognised());
  EXPECT_EQ(names.bone_of_region, (std::vector<int>{-1, -1, -1}));
  EXPECT_FALSE(name_bones(model_wrist(), {}).recognised());
}

}  // namespace
}  // namespace osteon
