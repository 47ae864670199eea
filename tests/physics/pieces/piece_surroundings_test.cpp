#include "pieces/piece_surroundings.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <random>

#include "mesh/shapes.h"
#include "osteon/carve/carved_field.h"

namespace osteon {
namespace {

PieceObstacle box_obstacle(const Vec3& half) {
  PieceObstacle out;
  out.box_B.include(half);
  out.box_B.include(-half);
  PieceObstacle::Part part{out.box_B, {}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      part.planes_B.push_back({sign * Vec3::Unit(axis), half[axis]});
  out.parts.push_back(part);
  return out;
}

// Two boxes, a ball of bone that is carved, and a rod in a hand.
class PieceSurroundingsTest : public ::testing::Test {
 protected:
  PieceSurroundingsTest() {
    setup_.bones = {box_obstacle({0.02, 0.01, 0.005}), box_obstacle({0.01, 0.01, 0.01}),
                    box_obstacle({0.001, 0.001, 0.001})};
    PieceTool tool;
    tool.parts.push_back(make_rod({0, 0, 0}, {0, 0, 0.03}, 0.003));
    setup_.tray.push_back(tool);
    bones_.count = 3;
    for (std::size_t b = 0; b < 3; ++b) bones_.bones[b].X_WB = {random_vec(0.03), random_turn()};
    hand_.instrument = 0;
    hand_.X_WP = {random_vec(0.02), random_turn()};
    field_.emplace(*CarvedField::make(*UncutField::make(test::sphere(0.012, 16))));
    carved_ = {nullptr, nullptr, &*field_};
  }
  double random(double most) { return std::uniform_real_distribution<>(-most, most)(random_); }
  Vec3 random_vec(double most) { return {random(most), random(most), random(most)}; }
  Quat random_turn() { return Quat(random(1), random(1), random(1), 1.5 + random(1)).normalized(); }
  PieceSurroundings around() const { return {setup_, tools_, bones_, carved_}; }

  std::mt19937 random_{3};
  PiecesSetup setup_;
  BoneSnapshot bones_;
  ToolState hand_;
  std::array<const ToolState*, 1> tools_{&hand_};
  std::optional<CarvedField> field_;
  std::array<const CarvedField*, 3> carved_{};
};

void expect_same(const PiecePush& a, const PiecePush& b) {
  EXPECT_EQ(a.depth_m, b.depth_m);
  EXPECT_EQ(a.out_W, b.out_W);
}

TEST_F(PieceSurroundingsTest, NeighboursAreThoseOfTheWholeBitByBit) {
  const PieceSurroundings all = around();
  int in_bone = 0, in_tool = 0, beyond = 0;
  for (int n = 0; n < 400; ++n) {
    const Vec3 from = n % 2 == 0 ? Vec3::Zero() : Vec3(hand_.X_WP * Vec3(0, 0, 0.015));
    const Vec3 center = from + random_vec(n % 2 == 0 ? 0.06 : 0.02);
    const double radius = 0.004 + random(0.003);
    const PieceNeighbours near(all, center, radius);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = center + random_vec(1.2 * radius);  // some are outside of the ball
      beyond += (p - center).norm() > radius;
      const PiecePush bone = all.in_bone(p), tool = all.in_tool(p);
      in_bone += bone.depth_m > 0;
      in_tool += tool.depth_m > 0;
      expect_same(near.in_bone(p), bone);
      expect_same(near.in_tool(p), tool);
    }
  }
  EXPECT_GT(in_bone, 100);
  EXPECT_GT(in_tool, 20);
  EXPECT_GT(beyond, 1000);
}

TEST_F(PieceSurroundingsTest, ABoneWhosePlaceIsNoNumberIsNotMet) {
  bones_.bones[0].X_WB.p.x() = std::numeric_limits<double>::quiet_NaN();
  const PieceSurroundings all = around();
  const Vec3 middle = bones_.bones[1].X_WB.p;
  const PiecePush found = PieceNeighbours(all, middle, 0.001).in_bone(middle);
  EXPECT_GT(found.depth_m, 0.005);
  EXPECT_TRUE(found.out_W.allFinite());
}

}  // namespace
}  // namespace osteon
