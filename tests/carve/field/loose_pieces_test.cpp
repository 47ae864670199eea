// What is cut off from the rest, and what is left when it is gone.
#include "osteon/carve/loose_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "carve/carve_fixtures.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/cut_surface.h"
#include "osteon/carve/node_moments.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using namespace test;

const std::shared_ptr<const UncutField>& small_block() {
  static const auto field = block_field(0.004);
  return field;
}

CarvedField whole_block() { return value(CarvedField::make(small_block(), {}, 2048)); }

// A saw cut of 1 mm across x and y, its middle at height z.
void saw(CarvedField& field, double z_m, double to_x_m = 0.006) {
  const Cutter burr = cutter("burr", 1);
  for (double y = -0.0045; y <= 0.0046; y += 0.0005)
    field.cut(burr, pose_along({-0.006, y, z_m}, Vec3::UnitZ()),
              pose_along({to_x_m, y, z_m}, Vec3::UnitZ()));
}

TEST(LoosePieces, AWholeBoneAndADrilledOneHangTogether) {
  CarvedField field = whole_block();
  LoosePieces loose(field);
  EXPECT_TRUE(loose.find(field).empty());
  field.cut(cutter("drill", 3), pose_along({0, 0, 0.006}, Vec3::UnitZ()),
            pose_along({0, 0, -0.006}, Vec3::UnitZ()));
  EXPECT_TRUE(loose.find(field).empty());
  // Sawn to 0.5 mm before the far side, it hangs on that.
  saw(field, 0.0015, 0.003);
  EXPECT_TRUE(loose.find(field).empty());
}

// Of 8 x 8 x 8 mm, sawn through between z = 1 and 2: the lid of 2 mm falls off, the rest of 5 mm is
// the bone, its surface closed and where it was.
TEST(LoosePieces, ALidThatIsSawnOffIsFoundAndTakenAway) {
  CarvedField field = whole_block();
  LoosePieces loose(field);
  (void)loose.find(field);
  saw(field, 0.0015);
  const auto& pieces = loose.find(field);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(1e9 * pieces[0].volume_m3, 8 * 8 * 2, 0.1 * 8 * 8 * 2);
  EXPECT_LT((pieces[0].middle_B - Vec3(0, 0, 0.003)).norm(), 2e-4);
  ASSERT_TRUE(loose.take_away(field, pieces[0], 0.004));
  EXPECT_TRUE(loose.find(field).empty());
  const TriMesh left = value(carved_mesh(field));
  EXPECT_TRUE(topology(left).closed());
  EXPECT_NEAR(1e9 * volume(left), 8 * 8 * 5, 0.01 * 8 * 8 * 5);
  for (const Vec3& v : left.vertices) ASSERT_LT(v.z(), 0.00115);
  EXPECT_NEAR(1e9 * total(removed_volume(field)), 8 * 8 * 3, 0.02 * 8 * 8 * 3);
  LoosePieces anew(field);
  EXPECT_TRUE(anew.find(field).empty());
}

// Where the lid was, cuts tell how far the bone below is: nothing of the lid is felt.
TEST(LoosePieces, AroundWhatFellOffTheDistanceIsThatToTheRest) {
  CarvedField field = whole_block();
  LoosePieces loose(field);
  saw(field, 0.0015);
  ASSERT_EQ(loose.find(field).size(), 1u);
  ASSERT_TRUE(loose.take_away(field, loose.find(field)[0], 0.004));
  const BlockGrid& grid = field.grid();
  int looked = 0;
  for (std::uint32_t block = 0; block < grid.count(); ++block) {
    const std::int16_t* cuts = field.cuts(block);
    if (!cuts) continue;
    const auto at = grid.place(block);
    for (int n = 0; n < 512; ++n) {
      const Vec3 p = grid.node(8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64);
      if (p.z() < 0.0017 || p.z() > 0.0038 || p.head<2>().cwiseAbs().maxCoeff() > 0.003) continue;
      EXPECT_NEAR(-1e-6 * cuts[n], p.z() - 0.001, 1.5e-4) << p.transpose();
      ++looked;
    }
  }
  EXPECT_GT(looked, 3000);
}

TEST(LoosePieces, WhatHasNoRoomStaysAsItIs) {
  CarvedField field = whole_block();
  saw(field, 0.0015);
  CarvedField tight = value(CarvedField::make(small_block(), {}, field.block_count()));
  saw(tight, 0.0015);
  ASSERT_EQ(tight.hash(), field.hash());
  LoosePieces loose(tight);
  ASSERT_EQ(loose.find(tight).size(), 1u);
  EXPECT_FALSE(loose.take_away(tight, loose.find(tight)[0], 0.004));
  EXPECT_EQ(tight.hash(), field.hash());
}

// A shell that hung on nothing from the begin is a bone of its own: carved, it stays.
TEST(LoosePieces, ASecondShellIsNotLoose) {
  TriMesh two = box_mesh(Vec3::Constant(0.003));
  const TriMesh small = box_mesh(Vec3::Constant(0.001));
  const auto first = static_cast<std::uint32_t>(two.vertices.size());
  for (const Vec3& v : small.vertices) two.vertices.push_back(v + Vec3(0.006, 0, 0));
  for (const Triangle& t : small.triangles)
    two.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  CarvedField field = value(CarvedField::make(value(UncutField::make(two)), {}, 2048));
  LoosePieces loose(field);
  field.cut(cutter("burr", 1), pose_along({0.006, 0, 0.001}, Vec3::UnitZ()));
  EXPECT_TRUE(loose.find(field).empty());
}

// Found by changed blocks alone it is what a search of the whole bone finds, undo included.
TEST(LoosePieces, ASearchOfWhatChangedFindsTheSameAsOneOfAll) {
  Random random(11);
  CarvedField field = whole_block();
  const CarveState begin = field.save();
  LoosePieces kept(field);
  std::size_t found = 0;
  for (int n = 0; n < 120; ++n) {
    const Vec3 p =
        0.004 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    field.cut(cutter("burr", random.uniform(1, 3)), pose_along(p, Vec3::UnitZ()),
              pose_along(p + 0.006 * random.direction(), Vec3::UnitZ()));
    if (n % 12 != 11) continue;
    LoosePieces anew(field);
    const auto& a = kept.find(field);
    const auto& b = anew.find(field);
    ASSERT_EQ(a.size(), b.size()) << n;
    found += a.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].volume_m3, b[i].volume_m3);
      EXPECT_EQ(a[i].middle_B, b[i].middle_B);
    }
    if (n == 59) {
      ASSERT_TRUE(field.restore(begin));
    }
  }
  EXPECT_GT(found, 0u);
}

TEST(RemovedNodes, OfAHoleAreThoseOfItsCylinder) {
  CarvedField field = whole_block();
  RemovedNodes removed(field);
  EXPECT_EQ(removed.of(field).count, 0);
  field.cut(cutter("drill", 3), pose_along({0.001, 0, 0.009}, Vec3::UnitZ()),
            pose_along({0.001, 0, -0.009}, Vec3::UnitZ()));
  const NodeMoments gone = removed.of(field);
  const double h = field.grid().cell_m, volume = h * h * h * static_cast<double>(gone.count);
  const double wanted = std::numbers::pi * 0.0015 * 0.0015 * 0.008;
  EXPECT_NEAR(volume, wanted, 0.03 * wanted);
  const double x = field.grid().lo.x() +
                   h * static_cast<double>(gone.first[0]) / static_cast<double>(gone.count);
  EXPECT_NEAR(x, 0.001, 5e-5);
  // In one go it is the same as step by step.
  RemovedNodes anew(field);
  EXPECT_EQ(anew.of(field), gone);
  EXPECT_NEAR(h * h * h * static_cast<double>(whole_nodes(field.bone()).count), 512e-9,
              0.06 * 512e-9);
}

// Counted with their sides, both surfaces together enclose what was removed, and only there.
TEST(CutSurface, EnclosesWhatWasRemoved) {
  CarvedField field = whole_block();
  EXPECT_TRUE(cut_surface(field).triangles.empty());
  const double whole = volume(value(carved_mesh(field)));
  field.cut(cutter("drill", 2), pose_along({0.001, 0, 0.006}, Vec3::UnitZ()),
            pose_along({0.001, 0, -0.001}, Vec3::UnitZ()));
  const TriMesh cut = cut_surface(field);
  const double wanted = whole - volume(value(carved_mesh(field)));
  EXPECT_NEAR(volume(cut), wanted, 1e-6 * wanted);
  for (const Vec3& v : cut.vertices)
    EXPECT_LT((v.head<2>() - Eigen::Vector2d(0.001, 0)).norm(), 0.006);
}

// What hangs on something stays, be it the smaller part; of a bone that hangs on nothing all is
// loose.
TEST(LoosePieces, WhatHangsStaysHoweverSmallItIs) {
  CarvedField field = whole_block();
  LoosePieces loose(field);
  loose.hang(field, [](const Vec3& p_B) { return p_B.z() > 0.0035; });
  EXPECT_TRUE(loose.find(field).empty());
  saw(field, 0.0015);
  const auto& pieces = loose.find(field);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(1e9 * pieces[0].volume_m3, 8 * 8 * 5, 0.1 * 8 * 8 * 5);
  EXPECT_LT(pieces[0].middle_B.z(), 0);
  ASSERT_TRUE(loose.take_away(field, pieces[0], 0.004));
  EXPECT_TRUE(loose.find(field).empty());
  // Two parts may hang.
  CarvedField halves = whole_block();
  LoosePieces both(halves);
  both.hang(halves, [](const Vec3& p_B) { return std::abs(p_B.z()) > 0.0035; });
  saw(halves, 0.0015);
  EXPECT_TRUE(both.find(halves).empty());
  CarvedField free = whole_block();
  LoosePieces nothing(free);
  nothing.hang(free, [](const Vec3&) { return false; });
  EXPECT_EQ(nothing.find(free).size(), 1u);
}

}  // namespace
}  // namespace osteon
