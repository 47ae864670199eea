#include "commands/shapes/collide_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "../../../collide/shapes.h"

namespace osteon {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::array<double, 10> values(const std::string& line) {
  std::array<double, 10> v{};
  std::istringstream in(line);
  char comma;
  for (double& x : v) in >> x >> comma;
  return v;
}

TEST(CollideTable, OneLineEachPoseInMillimetres) {
  const ConvexBody cube = shapes::body(shapes::box({0.01, 0.01, 0.01}));
  const std::vector<Pose> X_AB = {{Vec3(0.018, 0, 0), Quat::Identity()},
                                  {Vec3(0, -0.03, 0), Quat::Identity()},
                                  {Vec3(0, 0, 0.02), Quat::Identity()}};
  const auto table = make_collide_table(cube, cube, X_AB);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->poses, 3u);
  EXPECT_EQ(table->hits, 2u);
  const auto rows = lines(table->csv);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "hit,depth_mm,nx,ny,nz,px_mm,py_mm,pz_mm,pivots,ns");
  const auto first = values(rows[1]);
  EXPECT_EQ(first[0], 1);
  EXPECT_NEAR(first[1], 2, 1e-9);
  EXPECT_NEAR(first[2], 1, 1e-12);
  EXPECT_NEAR(first[5], 9, 1e-9);
  EXPECT_GT(first[9], 0);
  const auto second = values(rows[2]);
  EXPECT_EQ(second[0], 0);
  EXPECT_EQ(second[1], 0);
  EXPECT_NEAR(second[3], -1, 1e-12);
  const auto third = values(rows[3]);
  EXPECT_EQ(third[0], 1);
  EXPECT_NEAR(third[1], 0, 1e-12);
}

}  // namespace
}  // namespace osteon
