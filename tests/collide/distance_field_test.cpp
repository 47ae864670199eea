#include "osteon/collide/distance_field.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

constexpr double kRadius = 0.004;
constexpr std::uint32_t kRings = 40;

DistanceField field_of(const TriMesh& mesh, const FieldOptions& options = {}) {
  auto made = DistanceField::make(mesh, options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  return std::move(*made);
}

const DistanceField& ball_field() {
  static const DistanceField field = field_of(test::sphere(kRadius, kRings));
  return field;
}

TEST(DistanceField, WhatHasNoInsideIsAnError) {
  EXPECT_FALSE(DistanceField::make({}));
  TriMesh open = test::cube(0.005);
  open.triangles.pop_back();
  const auto refused = DistanceField::make(open);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("open"), std::string::npos);
  TriMesh inverted = test::cube(0.005);
  for (Triangle& t : inverted.triangles) test::flip(t);
  EXPECT_FALSE(DistanceField::make(inverted));
  TriMesh turned = test::cube(0.005);
  test::flip(turned.triangles[3]);
  EXPECT_FALSE(DistanceField::make(turned));
  TriMesh broken = test::cube(0.005);
  broken.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DistanceField::make(broken));
  EXPECT_FALSE(DistanceField::make(test::cube(1e-8)));
}

TEST(DistanceField, ATinyBoneGetsFinerCells) {
  const DistanceField field = field_of(test::cube(0.0005));
  EXPECT_LE(field.cell_m(), 0.001 / 16 * 1.0001);
  EXPECT_NEAR(field.at(Vec3(0, 0, 0.0007)).distance, 0.0002, 1e-6);
  EXPECT_NEAR(field.at(Vec3(0, 0, 0.0004)).distance, -0.0001, 1e-6);
}

TEST(DistanceField, MemoryIsBounded) {
  FieldOptions options;
  options.most_blocks = 50;
  const DistanceField field = field_of(test::sphere(kRadius, 20), options);
  EXPECT_GT(field.cell_m(), options.cell_m);
  EXPECT_LE(field.data().height.size(), 50 * FieldData::kBlock);
  EXPECT_NEAR(field.at(Vec3(kRadius, 0, 0)).distance, 0, 0.0002);
}

TEST(DistanceField, APlaceThatIsNotANumberHasNoDistance) {
  const FieldSample s = ball_field().at(Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0));
  EXPECT_TRUE(std::isnan(s.distance));
  EXPECT_FALSE(s.near);
}

// Within the band, far from it and beyond the grid.
TEST(DistanceField, TheDistanceAloneHasTheSameBits) {
  const DistanceField& field = ball_field();
  EXPECT_TRUE(std::isnan(field.distance_at(Vec3(0, std::numeric_limits<double>::infinity(), 0))));
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    const double height = random.uniform(0, i % 3 == 0 ? 4 : 1.2);
    const Vec3 p = kRadius * height * random.direction();
    ASSERT_EQ(std::bit_cast<std::uint64_t>(field.distance_at(p)),
              std::bit_cast<std::uint64_t>(field.at(p).distance))
        << p.transpose();
  }
}

TEST(DistanceField, OnTheSurfaceTheDistanceIsNothing) {
  const TriMesh mesh = test::sphere(kRadius, kRings);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 7) {
    const FieldSample s = ball_field().at(mesh.vertices[i]);
    EXPECT_TRUE(s.near);
    EXPECT_NEAR(s.distance, 0, 1e-5) << i;
  }
}

TEST(DistanceField, FarOffItIsABoundThatRisesAway) {
  Random random(3);
  int far = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction = random.direction();
    const double r = 0.015 * random.uniform();
    const FieldSample s = ball_field().at(r * direction);
    const double truth = r - kRadius;
    if (s.near) continue;
    ++far;
    EXPECT_LE(std::abs(s.distance), std::abs(truth) + 3e-5);
    EXPECT_GE(s.distance * truth, 0);
    if (r > 0.002) {
      EXPECT_GT(s.gradient.normalized().dot(direction), 0.5) << r;
    }
  }
  EXPECT_GT(far, 1000);
}

TEST(DistanceField, InTheBandItIsTheDistanceOfTheMesh) {
  const MeshDistance truth(test::sphere(kRadius, kRings));
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction = random.direction();
    const double height = -0.0005 + 0.00175 * random.uniform();
    const Vec3 p = (kRadius + height) * direction;
    const FieldSample s = ball_field().at(p);
    EXPECT_NEAR(s.distance, truth.closest(p).signed_distance, 6e-6);
    EXPECT_LT((s.gradient - direction).norm(), 0.05);
  }
}

// The slope is that of the value, and both go on smoothly over cells and blocks.
TEST(DistanceField, TheGradientIsTheSlopeAndHasNoJumps) {
  const DistanceField& field = ball_field();
  constexpr double kStep = 1e-6;
  Vec3 last = field.at(Vec3(-0.002, 0.0038, 0.0004)).gradient;
  for (int i = 1; i < 4000; ++i) {
    const Vec3 p(-0.002 + kStep * i, 0.0038, 0.0004);
    const FieldSample s = field.at(p);
    ASSERT_TRUE(s.near);
    EXPECT_LT((s.gradient - last).norm(), 0.001) << i;
    last = s.gradient;
    if (i % 100 != 0) continue;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Vec3 step = kStep * Vec3::Unit(k);
      const double rise = field.at(p + step).distance - field.at(p - step).distance;
      EXPECT_NEAR(rise / (2 * kStep), s.gradient[k], 1e-4);
    }
  }
}

TEST(DistanceField, DataThatDoesNotFitTogetherIsRefused) {
  const FieldData good = ball_field().data();
  ASSERT_TRUE(DistanceField::from(good));
  EXPECT_EQ(DistanceField::from(good)->hash(), ball_field().hash());
  const auto refused = [&](auto&& spoil) {
    FieldData bad = good;
    spoil(bad);
    return DistanceField::from(std::move(bad)) == nullptr;
  };
  EXPECT_TRUE(refused([](FieldData& d) { d.height.pop_back(); }));
  EXPECT_TRUE(refused([](FieldData& d) { d.middle.pop_back(); }));
  EXPECT_TRUE(refused([](FieldData& d) { d.stored[0] = 1u << 20; }));
  EXPECT_TRUE(refused([](FieldData& d) { d.blocks[1] = 0; }));
  EXPECT_TRUE(refused([](FieldData& d) { d.blocks[2] = -d.blocks[2]; }));
  EXPECT_TRUE(refused([](FieldData& d) { d.cell_m = 0; }));
  EXPECT_TRUE(refused([](FieldData& d) { d.lo.x() = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](FieldData& d) { d.middle[0] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](FieldData& d) { d = {}; }));
}

// The height of a wide cube's face is a plane: the splines give it exactly, but for their rounding.
TEST(DistanceField, AFlatFaceIsFlat) {
  const DistanceField field = field_of(test::cube(0.005));
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double x = 0.003 * (2 * random.uniform() - 1);
    const double y = 0.003 * (2 * random.uniform() - 1);
    const double h = 0.001 * random.uniform();
    const FieldSample s = field.at(Vec3(x, y, 0.005 + h));
    EXPECT_NEAR(s.distance, h, 2e-7);
    EXPECT_LT((s.gradient - Vec3::UnitZ()).norm(), 1e-3);
  }
}

TEST(DistanceField, ARealBoneIsFollowed) {
  const auto file = test::shared_folder() / "anatomy/wrist/scaphoid.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  auto mesh = load_mesh(file, 1);
  ASSERT_TRUE(mesh);
  repair(*mesh);
  const DistanceField field = field_of(*mesh);
  const MeshDistance truth(*mesh);
  double worst = 0;
  double sum = 0;
  for (const Vec3& v : mesh->vertices) {
    const double off = std::abs(field.at(v).distance);
    worst = std::max(worst, off);
    sum += off;
  }
  EXPECT_LT(sum / static_cast<double>(mesh->vertices.size()), 1e-5);
  EXPECT_LT(worst, 1e-4);
  RecordProperty("worst_um", std::to_string(1e6 * worst));
  RecordProperty("mean_um", std::to_string(1e6 * sum / double(mesh->vertices.size())));
  RecordProperty("bytes", std::to_string(field.bytes()));
}

}  // namespace
}  // namespace osteon
