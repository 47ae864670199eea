#include "scope_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

/// Whether a place in clip space lies in any of the triangles.
bool is_in(const TriMesh& mesh, double x, double y) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    int left = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.vertices[triangle[k]], &b = mesh.vertices[triangle[(k + 1) % 3]];
      left += (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()) >= 0;
    }
    return left == 0 || left == 3;
  });
}

TEST(UnseenCorners, ASmallPictureHasNone) {
  EXPECT_TRUE(unseen_corners(16).triangles.empty());
  EXPECT_TRUE(unseen_corners(77).triangles.empty());
  EXPECT_FALSE(unseen_corners(78).triangles.empty());
}

// Light is softened by so many pixels: these have to be drawn.
TEST(UnseenCorners, KeepOffTheRoundPictureAndCoverMostOfTheRest) {
  constexpr double kSoftened_px = 12;
  for (const int side : {160, 512, 1000, 2048}) {
    const TriMesh corners = unseen_corners(side);
    int unseen = 0, covered = 0;
    for (int row = 0; row < 200; ++row)
      for (int column = 0; column < 200; ++column) {
        const double x = (column + 0.5) / 100 - 1, y = (row + 0.5) / 100 - 1;
        const double off_px = (std::hypot(x, y) - 1) * side / 2;
        const bool in = is_in(corners, x, y);
        EXPECT_FALSE(in && off_px < kSoftened_px) << side << " " << x << " " << y;
        if (off_px < 17) continue;
        ++unseen;
        covered += in;
      }
    EXPECT_GT(covered, 0.97 * unseen) << side;
  }
}

// A band of these half sizes about the origin.
SoftPart band(const Vec3& half) {
  SoftPart soft;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        soft.mesh_W.vertices.push_back(half.cwiseProduct(Vec3(x, y, z)));
  return soft;
}

TissuePart found(const SoftPart& soft, TissuePattern pattern = TissuePattern::kFibres) {
  TissuePart part;
  part.pattern = pattern;
  find_fibres(soft, part);
  return part;
}

TEST(FibresOfAPart, OfNothingAreAsTheyWere) {
  const TissuePart part = found({});
  EXPECT_EQ(part.fibre, TissuePart().fibre);
  EXPECT_EQ(part.fineness, 1);
  const TissuePart flat = found(band(Vec3(0.01, 0.004, 0)));
  EXPECT_EQ(flat.fineness, 3);
}

TEST(FibresOfAPart, WithoutFootprintsRunAlongItsLongestAxis) {
  EXPECT_NEAR(std::abs(found(band({0.003, 0.010, 0.002})).fibre.y()), 1, 1e-6);
  const auto meniscus = found(band({0.003, 0.010, 0.002}), TissuePattern::kMeniscus);
  EXPECT_NEAR(std::abs(meniscus.fibre.z()), 1, 1e-6);
}

// The scapholunate ligament is wider than it is long.
TEST(FibresOfAPart, RunFromOneBoneToTheOtherHoweverWideItIs) {
  SoftPart soft = band({0.0015, 0.005, 0.0008});
  soft.attachments = {{"a", BoneId{3}, Vec3(-0.002, 0.004, 0)},
                      {"b", BoneId{1}, Vec3(0.002, 0.001, 0)},
                      {"c", BoneId{3}, Vec3(-0.002, -0.004, 0)},
                      {"d", BoneId{1}, Vec3(0.002, -0.001, 0)}};
  const TissuePart part = found(soft);
  EXPECT_NEAR(std::abs(part.fibre.x()), 1, 1e-6);
  EXPECT_NEAR(part.fineness, 0.004 / 0.0016, 1e-5);
  soft.attachments.push_back({"e", BoneId{2}, Vec3::Zero()});
  EXPECT_NEAR(std::abs(found(soft).fibre.y()), 1, 1e-6);
  soft.attachments = {{"a", BoneId{3}, Vec3::Zero()}, {"b", BoneId{1}, Vec3(0.0005, 0, 0)}};
  EXPECT_NEAR(std::abs(found(soft).fibre.y()), 1, 1e-6);
}

// The shader draws the rim where the product with one of these is 1.
TEST(FibresOfAPart, OfADiscAreMeasuredFromTheMiddleBetweenItsRims) {
  SoftPart soft = band({0.006, 0.001, 0.009});
  for (int k = 0; k < 40; ++k) soft.mesh_W.vertices.emplace_back(0, 0, 0.0085 + 1e-5 * k);
  const Vec3 off(0.01, -0.02, 0.03);
  for (Vec3& v : soft.mesh_W.vertices) v += off;
  const TissuePart disc = found(soft, pattern_of("disc"));
  EXPECT_NEAR(std::abs(disc.fibre.y()), 1, 1e-3);
  EXPECT_NEAR((disc.center.cast<double>() - off).norm(), 0, 5e-4);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 end = off + Vec3(0, 0, side * 0.009) - disc.center.cast<double>();
    EXPECT_NEAR(std::abs(disc.to_end.cast<double>().dot(end)), 1, 0.05);
    const Vec3 edge = off + Vec3(side * 0.006, 0, 0) - disc.center.cast<double>();
    EXPECT_NEAR(std::abs(disc.to_side.cast<double>().dot(edge)), 1, 0.05);
  }
  const Pose X_WB{{0, 0, 1}, Quat(Eigen::AngleAxisd(1.2, Vec3::UnitX()))};
  const TissuePart loose = loose_part_of(disc, X_WB);
  EXPECT_LT((X_WB.rotate(loose.to_end.cast<double>()) - disc.to_end.cast<double>()).norm(), 1e-3);
  EXPECT_LT((X_WB.rotate(loose.to_side.cast<double>()) - disc.to_side.cast<double>()).norm(), 1e-3);
}

TEST(FibresOfAPart, OfAThickOneAreNotCoarser) {
  EXPECT_EQ(found(band({0.005, 0.016, 0.0035})).fineness, 1);
}

}  // namespace
}  // namespace osteon
