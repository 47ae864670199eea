#include "osteon/collide/cut_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kCell_m = 0.00025, kSlack_m = 2e-5;
constexpr int kBlocks = 2, kNodes = CutField::kSide * kBlocks;  // along an axis
constexpr double kKnown_um = 625;                               // 2.5 cells

// Two blocks along each axis, of which the last one is not cut; and the cuts at all nodes.
struct Cuts {
  CutField field{{kCell_m, Vec3(0.001, -0.002, 0.003), {kBlocks, kBlocks, kBlocks}}, 8, kSlack_m};
  std::vector<double> um = std::vector<double>(kNodes * kNodes * kNodes, kKnown_um);

  Cuts() {
    Random random(11);
    std::array<std::int16_t, CutField::kNodes> block{};
    for (std::uint32_t b = 0; b < 7; ++b) {
      for (std::size_t n = 0; n < block.size(); ++n) {
        block[n] = static_cast<std::int16_t>(std::lround(random.uniform(-600, 900)));
        const std::size_t x = 8 * (b & 1) + n % 8, y = 8 * (b >> 1 & 1) + n / 8 % 8,
                          z = 8 * (b >> 2) + n / 64;
        um[(z * kNodes + y) * kNodes + x] = std::min<double>(block[n], kKnown_um);
      }
      EXPECT_TRUE(field.set(b, block));
    }
  }
  Vec3 at(const Vec3& cells) const { return field.grid().lo + kCell_m * cells; }

  // The basis by the recursion of Cox and de Boor, node by node.
  static double basis(double x) {
    const double a = std::abs(x);
    if (a >= 2) return 0;
    return a >= 1 ? std::pow(2 - a, 3) / 6 : 2.0 / 3 - a * a + 0.5 * a * a * a;
  }
  double height(const Vec3& cells) const {
    double sum = 0;
    for (int z = 0; z < kNodes; ++z)
      for (int y = 0; y < kNodes; ++y)
        for (int x = 0; x < kNodes; ++x)
          sum += basis(cells.x() - x) * basis(cells.y() - y) * basis(cells.z() - z) *
                 um[static_cast<std::size_t>((z * kNodes + y) * kNodes + x)];
    return kSlack_m - 1e-6 * sum;
  }
};

TEST(CutField, OfNothingCutNothingIsKnown) {
  const CutField field({kCell_m, Vec3::Zero(), {2, 2, 2}}, 8, kSlack_m);
  FieldSample sample;
  double distance = 0;
  EXPECT_TRUE(field.empty());
  EXPECT_FALSE(field.height(Vec3::Constant(0.001), sample));
  EXPECT_FALSE(field.distance(Vec3::Constant(0.001), distance));
}

// A value needs four nodes along each axis.
TEST(CutField, AtTheBorderAndBeyondItNothingIsKnown) {
  const Cuts cuts;
  FieldSample sample;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-1.0, 0.0, 0.999, 14.0, 15.5, 1e9, -1e9, nan})
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Vec3 cells = Vec3::Constant(5.5);
      cells[axis] = wrong;
      EXPECT_FALSE(cuts.field.height(cuts.at(cells), sample)) << wrong;
    }
  EXPECT_TRUE(cuts.field.height(cuts.at(Vec3::Constant(1.001)), sample));
  EXPECT_TRUE(cuts.field.height(cuts.at({13.999, 13.999, 1.001}), sample));
}

TEST(CutField, InAndBetweenBlocksItIsTheSplineOfAllNodes) {
  const Cuts cuts;
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(1.001, 13.999), y = random.uniform(1.001, 13.999),
                 z = random.uniform(1.001, 13.999);
    const Vec3 cells(x, y, z);
    FieldSample sample;
    double distance = 0;
    const bool known = cells.minCoeff() < 9;  // else all nodes are of the block that nothing cut
    ASSERT_EQ(cuts.field.height(cuts.at(cells), sample), known);
    ASSERT_EQ(cuts.field.distance(cuts.at(cells), distance), known);
    if (!known) continue;
    EXPECT_EQ(distance, sample.distance);
    EXPECT_NEAR(distance, cuts.height(cells), 1e-12);
  }
}

TEST(CutField, ItsSlopeIsThatOfItsHeight) {
  const Cuts cuts;
  Random random(4);
  constexpr double kStep = 1e-4;  // cells
  for (int i = 0; i < 100; ++i) {
    const double x = random.uniform(1.1, 13.9), y = random.uniform(1.1, 13.9),
                 z = random.uniform(1.1, 8.9);
    const Vec3 cells(x, y, z);
    FieldSample sample;
    ASSERT_TRUE(cuts.field.height(cuts.at(cells), sample));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vec3 step = kStep * Vec3::Unit(axis);
      const double rise = (cuts.height(cells + step) - cuts.height(cells - step)) / (2 * kStep);
      EXPECT_NEAR(sample.gradient[axis], rise / kCell_m, 1e-6);
    }
  }
}

TEST(CutField, ABlockIsReplacedAndAllAreForgotten) {
  Cuts cuts;
  const std::uint64_t changes = cuts.field.changes();
  std::array<std::int16_t, CutField::kNodes> deep{};
  deep.fill(-400);
  ASSERT_TRUE(cuts.field.set(0, deep));
  EXPECT_EQ(cuts.field.used(), 7u);
  double distance = 0;
  ASSERT_TRUE(cuts.field.distance(cuts.at(Vec3::Constant(3.5)), distance));
  EXPECT_NEAR(distance, kSlack_m + 4e-4, 1e-12);
  EXPECT_FALSE(cuts.field.set(8, deep)) << "there is no such block";
  cuts.field.clear();
  EXPECT_TRUE(cuts.field.empty());
  EXPECT_FALSE(cuts.field.distance(cuts.at(Vec3::Constant(3.5)), distance));
  EXPECT_GT(cuts.field.changes(), changes + 1);
}

}  // namespace
}  // namespace osteon
