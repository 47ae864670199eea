#include "osteon/carve/carved_field.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numbers>

#include "carve/carve_fixtures.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;

const std::shared_ptr<const UncutField>& block() {
  static const auto field = block_field(0.008);
  return field;
}

CarvedField fresh() { return value(CarvedField::make(block(), {}, 4096)); }

// So many random directions; with OSTEON_LONG 200.
int directions(int few) { return std::getenv("OSTEON_LONG") ? 200 : few; }

double removed_mm3(const CarvedField& field) { return 1e9 * total(removed_volume(field)); }

TEST(CarvedField, AStepThatIsNotFiniteDoesNothing) {
  CarvedField field = fresh();
  const auto before = field.hash();
  Pose bad;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field.cut(cutter("burr", 4), bad).status, CarveStep::kNotFinite);
  Cutter broken = cutter("burr", 4);
  broken.parts[0].rods[0].radius = std::numeric_limits<double>::infinity();
  EXPECT_EQ(field.cut(broken, Pose{}).status, CarveStep::kNotFinite);
  EXPECT_EQ(field.hash(), before);
  EXPECT_EQ(field.block_count(), 0u);
}

TEST(CarvedField, ACutThroughAirRemovesNothingAndTakesNoBlock) {
  CarvedField field = fresh();
  Pose far;
  far.p.x() = 0.1;
  const CarveStep step = field.cut(cutter("burr", 4), far);
  EXPECT_EQ(step.status, 0u);
  EXPECT_EQ(total(step.removed_m3), 0);
  EXPECT_EQ(field.block_count(), 0u);
}

TEST(CarvedField, AWayThatTakesTooManyPlacesIsRefused) {
  CarvedField field = fresh();
  Pose far;
  far.p.x() = 1;
  EXPECT_EQ(field.cut(cutter("drill", 4), Pose{}, far).status, CarveStep::kTooLong);
  EXPECT_EQ(field.block_count(), 0u);
}

TEST(CarvedField, ABallRemovesItsVolume) {
  Random random(1);
  for (int n = 0; n < directions(12); ++n) {
    CarvedField field = fresh();
    const double r = random.uniform(1.5, 3.0);
    Pose X;
    X.p = random.uniform(0, 0.004) * random.direction();
    field.cut(cutter("burr", 2 * r), X);
    const double ball = 4 * kPi * r * r * r / 3;
    EXPECT_NEAR(removed_mm3(field), ball, 0.005 * ball) << "radius " << r;
  }
}

// The way of a ball in short steps, straight: a cylinder with round ends.
TEST(CarvedField, ABallsWayRemovesItsVolume) {
  Random random(2);
  for (int n = 0; n < directions(12); ++n) {
    CarvedField field = fresh();
    const Vec3 along = random.direction();
    constexpr int kSteps = 60;
    const auto at = [&](int s) {
      Pose X;
      X.p = (0.008 * s / kSteps - 0.004) * along;
      return X;
    };
    for (int s = 0; s < kSteps; ++s) field.cut(cutter("burr", 4), at(s), at(s + 1));
    const double rod = kPi * 4 * 8 + 4 * kPi * 8 / 3;
    EXPECT_NEAR(removed_mm3(field), rod, 0.005 * rod);
  }
}

// A drill that enters by a face of the block and stops inside, at a slant: its point is a cone of
// 118 degrees.
TEST(CarvedField, ADrillRemovesACylinderWithAPoint) {
  Random random(3);
  for (int n = 0; n < directions(12); ++n) {
    CarvedField field = fresh();
    const double r = random.uniform(1.5, 2.5), tilt = random.uniform(0, 0.4);
    const double turn = random.uniform(0, 2 * kPi);
    const Vec3 up(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    const Pose from = pose_along(0.014 * up, up), to = pose_along(-0.003 * up, up);
    EXPECT_EQ(field.cut(cutter("drill", 2 * r), from, to).status, CarveStep::kRemoved);
    const double cone = r / std::tan(59 * kPi / 180);
    const double axis = 8 / up.z() + 3;  // from the face to the point
    const double hole = kPi * r * r * (axis - cone) + kPi * r * r * cone / 3;
    EXPECT_NEAR(removed_mm3(field), hole, 0.005 * hole) << "radius " << r << ", tilt " << tilt;
  }
}

// An awl pushed through a face, straight and at a slant: a cone of 30 degrees, cut off by the face.
TEST(CarvedField, AnAwlRemovesACone) {
  Random random(4);
  for (int n = 0; n < directions(12); ++n) {
    CarvedField field = fresh();
    const double tilt = random.uniform(0, 0.3), turn = random.uniform(0, 2 * kPi);
    const Vec3 up(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    const double depth = random.uniform(7, 9);  // mm of the point under the face
    const Pose end = pose_along({0, 0, 0.008 - 1e-3 * depth}, up);
    field.cut(cutter("awl", 8), end);
    // The face cuts it in an ellipse of half axes depth sin cos / c and depth sin / sqrt(c).
    const double angle = 15 * kPi / 180,
                 c = std::pow(std::cos(tilt), 2) - std::pow(std::sin(angle), 2);
    const double ellipse =
        kPi * std::pow(depth * std::sin(angle), 2) * std::cos(angle) / std::pow(c, 1.5);
    const double cone = ellipse * depth / 3;
    EXPECT_NEAR(removed_mm3(field), cone, 0.005 * cone) << "tilt " << tilt;
  }
}

TEST(CarvedField, TheWallOfADrilledHoleIsACylinder) {
  Random random(5);
  for (int n = 0; n < directions(20); ++n) {
    CarvedField field = fresh();
    const double r = random.uniform(1, 3);
    const double tilt = random.uniform(0, 0.5), turn = random.uniform(0, 2 * kPi);
    const Vec3 up(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    field.cut(cutter("drill", 2 * r), pose_along(0.016 * up, up), pose_along(-0.016 * up, up));
    const TriMesh mesh = value(carved_mesh(field));
    double worst = 0, walls = 0;
    for (const Vec3& v : mesh.vertices) {
      const double rho = 1e3 * (v - up * up.dot(v)).norm();
      if (rho > r + 1) continue;
      const double face = 8 - 1e3 * v.cwiseAbs().maxCoeff();  // 0 on the block's faces
      if (rho < r + 0.4 && face > 0.15) {
        worst = std::max(worst, std::abs(rho - r));
        ++walls;
      }
      // Nothing of the bone reaches into the hole, rim included.
      EXPECT_GT(rho, r - 0.15);
    }
    EXPECT_GT(walls, 1000);
    EXPECT_LT(worst, 0.1);
  }
}

// Every point of the true rim, where the cylinder leaves a face, has a vertex near it.
TEST(CarvedField, TheRimOfADrilledHoleIsSharp) {
  for (const double tilt : {0.0, 0.3, 0.6}) {
    CarvedField field = fresh();
    const double r = 0.002;
    const Vec3 up(std::sin(tilt), 0, std::cos(tilt));
    field.cut(cutter("drill", 4), pose_along(0.02 * up, up), pose_along(-0.016 * up, up));
    const TriMesh mesh = value(carved_mesh(field));
    double farthest = 0;
    for (int n = 0; n < 360; ++n) {
      const double a = n * kPi / 180;
      const Vec3 side = r * (std::cos(a) * Vec3(std::cos(tilt), 0, -std::sin(tilt)) +
                             std::sin(a) * Vec3::UnitY());
      const Vec3 rim = side + up * ((0.008 - side.z()) / up.z());
      double near = 1;
      for (const Triangle& t : mesh.triangles) {
        const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
        if ((middle - rim).norm() > 0.0006) continue;
        for (int k = 0; k < 3; ++k)  // of its edges
          for (int s = 0; s <= 4; ++s) {
            const Vec3 p = mesh.vertices[t[static_cast<std::size_t>(k)]] * (1 - 0.25 * s) +
                           mesh.vertices[t[static_cast<std::size_t>((k + 1) % 3)]] * (0.25 * s);
            near = std::min(near, (p - rim).norm());
          }
      }
      farthest = std::max(farthest, near);
    }
    EXPECT_LT(1e3 * farthest, 0.15) << "tilt " << tilt;
  }
}

TEST(CarvedField, TheOrderOfCutsDoesNotMatter) {
  CarvedField one = fresh(), other = fresh();
  const Pose a = pose_along({0.001, 0, 0.004}, {0.6, 0, 0.8});
  const Pose b = pose_along({0.0005, 0.002, 0.005}, Vec3::UnitZ());
  one.cut(cutter("drill", 3), a);
  one.cut(cutter("burr", 5), b);
  other.cut(cutter("burr", 5), b);
  other.cut(cutter("drill", 3), a);
  EXPECT_EQ(one.hash(), other.hash());
  CarveState first = one.save(), second = other.save();
  EXPECT_EQ(first.blocks, second.blocks);
  EXPECT_GT(first.blocks.size(), 10u);
}

TEST(CarvedField, RestoringPutsTheBoneBack) {
  CarvedField field = fresh();
  const auto whole = field.hash();
  const CarveState nothing = field.save();
  EXPECT_TRUE(nothing.blocks.empty());
  field.cut(cutter("burr", 4), pose_along({0, 0, 0.007}, Vec3::UnitZ()));
  const CarveState once = field.save();
  const auto hash_once = field.hash();
  EXPECT_NE(hash_once, whole);
  const auto epoch = field.epoch();
  field.cut(cutter("drill", 3), pose_along({0.004, 0, 0.002}, Vec3::UnitZ()));
  EXPECT_NE(field.hash(), hash_once);
  ASSERT_TRUE(field.restore(once));
  EXPECT_EQ(field.hash(), hash_once);
  EXPECT_EQ(field.save(), once);
  EXPECT_NE(field.epoch(), epoch);
  ASSERT_TRUE(field.restore(nothing));
  EXPECT_EQ(field.hash(), whole);
  EXPECT_EQ(removed_mm3(field), 0);
}

TEST(CarvedField, AStateThatDoesNotFitIsRefusedAndChangesNothing) {
  CarvedField field = fresh();
  field.cut(cutter("burr", 4), pose_along({0, 0, 0.007}, Vec3::UnitZ()));
  const auto hash = field.hash();
  CarveState state = field.save();
  state.bone ^= 1;
  EXPECT_FALSE(field.restore(state));
  state = field.save();
  std::swap(state.blocks[0], state.blocks[1]);
  EXPECT_FALSE(field.restore(state));
  state = field.save();
  state.blocks.back().block = 0xfffffff0u;
  EXPECT_FALSE(field.restore(state));
  CarvedField small = value(CarvedField::make(block(), {}, 2));
  EXPECT_FALSE(small.restore(field.save()));
  EXPECT_EQ(field.hash(), hash);
}

TEST(CarvedField, WithoutABlockLeftAStepSaysSoAndLosesNothing) {
  CarvedField field = value(CarvedField::make(block(), {}, 20));
  const Cutter burr = cutter("burr", 2);
  int refused = 0;
  for (int n = 0; n < 200; ++n) {
    const auto hash = field.hash();
    const auto before = field.save().blocks;
    Pose X;
    X.p = {0.008 * n / 200 - 0.004, 0, 0};
    const CarveStep step = field.cut(burr, X);
    if ((step.status & CarveStep::kBlocksFull) == 0) continue;
    ++refused;
    EXPECT_EQ(field.hash(), hash);
    EXPECT_EQ(field.save().blocks, before);
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(removed_mm3(field), 3);
  EXPECT_LE(field.block_count(), 20u);
}

TEST(CarvedField, AnotherHolderFollowsByChangedBlocks) {
  CarvedField field = fresh(), other = fresh();
  const Cutter burr = cutter("burr", 3);
  std::uint64_t since = 0;
  for (int n = 0; n < 30; ++n) {
    field.cut(burr, pose_along({0.0002 * n, 0, 0.007}, Vec3::UnitZ()),
              pose_along({0.0002 * n + 0.0002, 0, 0.007}, Vec3::UnitZ()));
    if (n % 7 != 6 && n != 29) continue;
    std::size_t copied = 0;
    for (std::size_t b = 0; b < field.block_count(); ++b) {
      if (field.changed_at(b) <= since) continue;
      const std::int16_t* cuts = field.cuts(field.block_at(b));
      ASSERT_TRUE(other.apply(field.block_at(b),
                              std::span<const std::int16_t, BlockGrid::kNodes>(cuts, 512),
                              field.changed_at(b)));
      ++copied;
    }
    EXPECT_GT(copied, 0u);
    EXPECT_EQ(other.hash(), field.hash());
    since = field.step();
  }
}

// The block of 16 mm has a cortex of 1.2 mm all around; a burr of 6 mm halfway in a face.
TEST(CarvedField, WhatIsRemovedIsCountedByTissue) {
  CarvedField field = fresh();
  const CarveStep step = field.cut(cutter("burr", 6), pose_along({0, 0, 0.008}, Vec3::UnitZ()));
  const ByTissue removed = removed_volume(field);
  const double r = 3, t = 1.2;
  const double half = 2 * kPi * r * r * r / 3;
  const double cancellous = kPi * (r - t) * (r - t) * (2 * r + t) / 3;  // the cap under the cortex
  EXPECT_NEAR(1e9 * removed[0], half - cancellous, 0.01 * half);
  EXPECT_NEAR(1e9 * removed[1], cancellous, 0.01 * half);
  EXPECT_EQ(removed[2], 0);
  EXPECT_EQ(removed[3], 0);
  // By nodes, as a step says it.
  EXPECT_NEAR(1e9 * step.removed_m3[0], half - cancellous, 0.03 * half);
  EXPECT_NEAR(1e9 * step.removed_m3[1], cancellous, 0.03 * half);
}

TEST(CarvedField, LayersMustFit) {
  EXPECT_FALSE(CarvedField::make(block(), BoneLayers{{}}));
  EXPECT_FALSE(CarvedField::make(block(), BoneLayers{{{0.001, BoneTissue::kCortical}}}));
  EXPECT_FALSE(CarvedField::make(
      block(), BoneLayers{{{0, BoneTissue::kCortical}, {0, BoneTissue::kMarrow}}}));
  EXPECT_FALSE(bone_layers(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(bone_layers(0.002, 0.001));
  EXPECT_EQ(value(bone_layers(0.002, 0.005)).at(0.003), BoneTissue::kCancellous);
  EXPECT_EQ(value(bone_layers(0.002, 0.005)).at(0.006), BoneTissue::kMarrow);
}

}  // namespace
}  // namespace osteon
