#include "recognise/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr ScaleRange kAny{0.1, 10};

std::vector<Vec3> cloud(Random& random, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-0.04, 0.04), y = random.uniform(-0.02, 0.02);
    const double z = random.uniform(-0.01, 0.01);
    points.emplace_back(x, y, z);
  }
  return points;
}

ModelFit some_fit(Random& random, bool mirrored) {
  ModelFit fit;
  fit.X_PM.q = Quat(Eigen::AngleAxisd(random.uniform(-3, 3), random.direction()));
  fit.X_PM.p = 0.1 * random.direction();
  fit.scale = random.uniform(0.5, 2);
  fit.mirrored = mirrored;
  return fit;
}

TEST(BestFit, FindsTheSimilarityThatMadeThePairs) {
  Random random(1);
  for (int round = 0; round < 40; ++round) {
    const ModelFit truth = some_fit(random, round % 2 == 1);
    Pairs pairs;
    pairs.model_M = cloud(random, 4 + round);
    for (const Vec3& p : pairs.model_M) pairs.data_P.push_back(truth.to_patient(p));
    const ModelFit found = best_fit(pairs, kAny, truth.mirrored);
    EXPECT_NEAR(found.scale, truth.scale, 1e-9);
    for (const Vec3& p : pairs.model_M)
      EXPECT_LT((found.to_patient(p) - truth.to_patient(p)).norm(), 1e-12);
  }
}

TEST(BestFit, KeepsItsScaleWithinTheRange) {
  Random random(2);
  Pairs pairs;
  pairs.model_M = cloud(random, 30);
  for (const Vec3& p : pairs.model_M) pairs.data_P.push_back(3 * p);
  EXPECT_DOUBLE_EQ(best_fit(pairs, {0.8, 1.2}, false).scale, 1.2);
}

// The sum of squares has no better place near: the definition, not the formula.
TEST(BestFit, OfNoisyPairsIsALeastSum) {
  Random random(3);
  const ModelFit truth = some_fit(random, false);
  Pairs pairs;
  pairs.model_M = cloud(random, 50);
  for (const Vec3& p : pairs.model_M)
    pairs.data_P.push_back(truth.to_patient(p) + 0.002 * random.direction());
  const auto sum = [&](const ModelFit& fit) {
    double total = 0;
    for (std::size_t i = 0; i < pairs.model_M.size(); ++i)
      total += (fit.to_patient(pairs.model_M[i]) - pairs.data_P[i]).squaredNorm();
    return total;
  };
  const ModelFit found = best_fit(pairs, kAny, false);
  for (int i = 0; i < 200; ++i) {
    ModelFit other = found;
    other.X_PM.p += 1e-4 * random.direction();
    other.X_PM.q = Quat(Eigen::AngleAxisd(1e-3, random.direction())) * other.X_PM.q;
    other.scale *= 1 + random.uniform(-1e-3, 1e-3);
    EXPECT_LE(sum(found), sum(other));
  }
}

TEST(PrincipalAxes, OfABoxAreItsEdgesTheLongestFirst) {
  Random random(4);
  const Mat3 axes = principal_axes(cloud(random, 20000));
  EXPECT_NEAR(std::abs(axes(0, 0)), 1, 1e-3);
  EXPECT_NEAR(std::abs(axes(1, 1)), 1, 1e-3);
  EXPECT_NEAR(axes.determinant(), 1, 1e-9);
}

}  // namespace
}  // namespace osteon
