// What of a piece lies deep in its bone, by boxes.
#include "osteon/carve/piece_below.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "carve/carve_fixtures.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/mesh/covered_surface.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using namespace test;

// What is above a saw cut of 1 mm, its middle at height z.
std::shared_ptr<const PieceShape> sawn_lid(const std::shared_ptr<const UncutField>& bone,
                                           double half_m, double z_m) {
  CarvedField field = value(CarvedField::make(bone, {}, 8192));
  LoosePieces loose(field);
  const double to = half_m + 0.003;
  for (double y = -to; y <= to; y += 0.00025)
    (void)field.cut(cutter("burr", 1), pose_along({-to, y, z_m}, Vec3::UnitZ()),
                    pose_along({to, y, z_m}, Vec3::UnitZ()));
  const auto& pieces = loose.find(field);
  return pieces.size() == 1 ? PieceShape::of(field, loose, pieces[0], 0) : nullptr;
}

TEST(PieceBelow, NothingLiesDeeperThanThePiece) {
  const auto bone = block_field(0.004);
  const auto lid = sawn_lid(bone, 0.004, 0.0015);
  ASSERT_NE(lid, nullptr);
  EXPECT_EQ(piece_below(*lid, *bone, 0.0025), nullptr);
  EXPECT_EQ(piece_below(*lid, *bone, 1.0), nullptr);
}

TEST(PieceBelow, AtTheSurfaceItIsThePieceItself) {
  const auto bone = block_field(0.004);
  const auto lid = sawn_lid(bone, 0.004, 0.0015);
  ASSERT_NE(lid, nullptr);
  const auto same = piece_below(*lid, *bone, 0);
  ASSERT_NE(same, nullptr);
  EXPECT_EQ(same->grid().heights, lid->grid().heights);
}

// The lid reaches from z = 2 to 4 mm, its core from 2 to 2.8 and as far from the block's sides.
TEST(PieceBelow, TheCoreOfALidEndsAtTheSaw) {
  const auto bone = block_field(0.004);
  const auto lid = sawn_lid(bone, 0.004, 0.0015);
  ASSERT_NE(lid, nullptr);
  const auto core = piece_below(*lid, *bone, 0.0012);
  ASSERT_NE(core, nullptr);
  const TriMesh mesh = value(core->surface());
  EXPECT_TRUE(topology(mesh).closed());
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  EXPECT_LT((box.lo - Vec3(-0.0028, -0.0028, 0.002)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((box.hi - Vec3(0.0028, 0.0028, 0.0028)).cwiseAbs().maxCoeff(), 1e-4);
}

// Two millimetres of cartilage on the lid: they are no bone, and depths count from below them.
TEST(PieceBelow, CartilageIsTakenOff) {
  TriMesh layer = box_mesh({0.003, 0.003, 0.001});
  for (Vec3& v : layer.vertices) v.z() += 0.005;
  const auto covered =
      value(CoveredSurface::make(box_mesh(Vec3::Constant(0.004)), {std::move(layer)}));
  const auto bone = value(UncutField::make(covered));
  const auto lid = sawn_lid(bone, 0.004, 0.0015);
  ASSERT_NE(lid, nullptr);
  const auto height = [](const PieceShape& shape) {
    double top = -1;
    for (const Vec3& v : value(shape.surface()).vertices) top = std::max(top, v.z());
    return top;
  };
  EXPECT_NEAR(height(*lid), 0.006, 1e-4);
  const auto bare = piece_below(*lid, *bone, 0);
  ASSERT_NE(bare, nullptr);
  EXPECT_NEAR(height(*bare), 0.004, 1e-4);
  const auto core = piece_below(*lid, *bone, 0.0012);
  ASSERT_NE(core, nullptr);
  EXPECT_NEAR(height(*core), 0.0028, 1e-4);
}

}  // namespace
}  // namespace osteon
