#include "osteon/mesh/isosurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "mesh/surface_checks.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kPi = 3.14159265358979323846;

Aabb cube_box(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }
double sphere(const Vec3& p, double radius) { return p.norm() - radius; }
double ball_height(const Vec3& p) { return sphere(p, 0.01); }

IsosurfaceOptions cell(double size) {
  IsosurfaceOptions options;
  options.cell_m = size;
  return options;
}

TEST(Isosurface, RefusesUnusableCells) {
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(isosurface(ball_height, cube_box(0.02), cell(size))) << size;
  EXPECT_FALSE(isosurface(ball_height, cube_box(0.02), cell(1e-6))) << "a grid beyond memory";
}

TEST(Isosurface, RefusesEmptyAndInfiniteBoxes) {
  EXPECT_FALSE(isosurface(ball_height, Aabb{}, cell(0.001)));
  EXPECT_FALSE(
      isosurface(ball_height, cube_box(std::numeric_limits<double>::infinity()), cell(0.001)));
}

TEST(Isosurface, RefusesBadPromises) {
  IsosurfaceOptions options = cell(0.001);
  options.stretch = 0.5;
  EXPECT_FALSE(isosurface(ball_height, cube_box(0.02), options));
  options.stretch = 1;
  options.slack_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isosurface(ball_height, cube_box(0.02), options));
}

TEST(Isosurface, SaysWhenNothingIsInside) {
  const auto r = isosurface([](const Vec3&) { return 1.0; }, cube_box(0.01), cell(0.001));
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().what.find("inside"), std::string::npos);
}

TEST(Isosurface, SaysWhenTheInsideReachesTheRim) {
  EXPECT_FALSE(isosurface([](const Vec3&) { return -1.0; }, cube_box(0.01), cell(0.001)));
  EXPECT_FALSE(isosurface(ball_height, cube_box(0.008), cell(0.001)));
  const auto slab = [](const Vec3& p) { return std::abs(p.x()) - 0.002; };
  EXPECT_FALSE(isosurface(slab, cube_box(0.01), cell(0.001)));
}

TEST(Isosurface, RefusesFieldsThatAreNotFinite) {
  const auto field = [](const Vec3& p) {
    return p.x() > 0.004 ? std::numeric_limits<double>::quiet_NaN() : ball_height(p);
  };
  EXPECT_FALSE(isosurface(field, cube_box(0.02), cell(0.001)));
}

TEST(Isosurface, SphereHasItsVolumeAndRadius) {
  const auto mesh = isosurface(ball_height, cube_box(0.011), cell(0.0006));
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(checks::is_closed_manifold(*mesh));
  EXPECT_TRUE(checks::has_single_fans(*mesh));
  EXPECT_EQ(checks::euler_number(*mesh), 2);
  EXPECT_NEAR(checks::signed_volume(*mesh) / (4 * kPi / 3 * 1e-6), 1, 0.005);
  for (const Vec3& v : mesh->vertices) EXPECT_NEAR(v.norm(), 0.01, 1e-8);
}

TEST(Isosurface, EllipsoidAndTorusKeepTheirVolumes) {
  const Vec3 r(0.012, 0.008, 0.005);
  const auto ellipsoid = [&r](const Vec3& p) {
    return (p.cwiseQuotient(r).norm() - 1) * r.minCoeff();
  };
  const auto egg = isosurface(ellipsoid, cube_box(0.013), cell(0.0006));
  ASSERT_TRUE(egg);
  EXPECT_NEAR(checks::signed_volume(*egg) / (4 * kPi / 3 * r.prod()), 1, 0.01);

  const auto torus = [](const Vec3& p) {
    const double around = std::sqrt(p.x() * p.x() + p.y() * p.y()) - 0.01;
    return std::sqrt(around * around + p.z() * p.z()) - 0.003;
  };
  const auto ring = isosurface(torus, cube_box(0.014), cell(0.0006));
  ASSERT_TRUE(ring);
  EXPECT_TRUE(checks::is_closed_manifold(*ring));
  EXPECT_EQ(checks::euler_number(*ring), 0);
  EXPECT_NEAR(checks::signed_volume(*ring) / (2 * kPi * kPi * 0.01 * 9e-6), 1, 0.01);
}

TEST(Isosurface, ThinSheetsAndTouchingBallsStayManifold) {
  // A tilted sheet thinner than a cell, which the grid tears into shreds.
  const auto sheet = [](const Vec3& p) {
    const Vec3 n = Vec3(1, 0.7, 3).normalized();
    return std::max(std::abs(n.dot(p)) - 0.0001, p.norm() - 0.006);
  };
  const auto thin = isosurface(sheet, cube_box(0.008), cell(0.0005));
  ASSERT_TRUE(thin);
  EXPECT_TRUE(checks::is_closed_manifold(*thin));
  EXPECT_TRUE(checks::has_single_fans(*thin));
  const auto pair = [](const Vec3& p) {
    return std::min(sphere(p - Vec3(0.005, 0.0001, 0), 0.005),
                    sphere(p + Vec3(0.005, 0, 0.0001), 0.005));
  };
  const auto touching = isosurface(pair, cube_box(0.012), cell(0.0007));
  ASSERT_TRUE(touching);
  EXPECT_TRUE(checks::is_closed_manifold(*touching));
}

/// White noise holds every arrangement of a cell's corners, and every pair of ambiguous cells.
TEST(Isosurface, NoiseIsClosedAndManifold) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto noise = [seed](const Vec3& p) {
      const Vec3 n = (p / 0.001).array().round();
      if (n.cwiseAbs().maxCoeff() > 9.5) return 1.0;
      const auto at =
          static_cast<std::uint64_t>((n.x() + 50) * 10000 + (n.y() + 50) * 100 + n.z() + 50);
      Random random(seed * 1000003 + at);
      return random.uniform() < 0.2 + 0.05 * static_cast<double>(seed) ? -0.5 : 0.5;
    };
    IsosurfaceOptions options = cell(0.001);
    options.slack_m = 1;
    options.relax_steps = 0;
    const auto mesh = isosurface(noise, cube_box(0.01), options);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_TRUE(checks::is_closed_manifold(*mesh)) << seed;
    EXPECT_TRUE(checks::has_single_fans(*mesh)) << seed;
    EXPECT_GT(checks::signed_volume(*mesh), 0) << seed;
  }
}

TEST(Isosurface, SkippingBlocksChangesNothing) {
  const auto two = [](const Vec3& p) {
    return std::min(sphere(p - Vec3(0.02, 0, 0), 0.006), sphere(p + Vec3(0.02, 0.004, 0), 0.004));
  };
  IsosurfaceOptions every = cell(0.0007);
  every.slack_m = 1;
  const auto fast = isosurface(two, cube_box(0.03), cell(0.0007));
  const auto slow = isosurface(two, cube_box(0.03), every);
  ASSERT_TRUE(fast && slow);
  EXPECT_EQ(checks::hash_of(*fast), checks::hash_of(*slow));
  EXPECT_EQ(checks::euler_number(*fast), 4) << "two pieces";
}

/// Balls of which only those near a place are asked there.
class Balls : public LocalField {
 public:
  explicit Balls(int& asked) : asked_(asked) {
    for (int i = 0; i < 5; ++i) centers_.push_back(Vec3(0.011 * i - 0.022, 0.001 * i, 0));
  }
  double at(const Vec3& p) const override {
    double d = 1e300;
    for (const Vec3& c : centers_) d = std::min(d, sphere(p - c, kRadius));
    asked_ += static_cast<int>(centers_.size());
    return d;
  }
  Near near(const Vec3& center, double radius) const override {
    const double nearest = at(center);
    if (std::abs(nearest) > radius) return {nearest > 0 ? 1 : -1};
    auto here = std::make_unique<Balls>(asked_);
    std::erase_if(here->centers_, [&](const Vec3& c) {
      const bool kept = std::count(centers_.begin(), centers_.end(), c) > 0;
      return !kept || sphere(center - c, kRadius) > nearest + 2 * radius + 1e-9;
    });
    return {0, std::move(here)};
  }

 private:
  static constexpr double kRadius = 0.004;
  std::vector<Vec3> centers_;
  int& asked_;
};

TEST(Isosurface, AFieldThatKnowsItselfHasTheSameSurfaceSooner) {
  int near_asked = 0, plain_asked = 0;
  const Balls balls(near_asked), asked_plainly(plain_asked);
  IsosurfaceOptions options = cell(0.0006);
  const auto near = isosurface(balls, cube_box(0.03), options);
  const auto plain =
      isosurface([&](const Vec3& p) { return asked_plainly.at(p); }, cube_box(0.03), options);
  ASSERT_TRUE(near && plain);
  EXPECT_EQ(checks::hash_of(*near), checks::hash_of(*plain));
  EXPECT_LT(near_asked, plain_asked / 2);
}

TEST(Isosurface, TrianglesAreWellShaped) {
  const auto mesh = isosurface(ball_height, cube_box(0.011), cell(0.0006));
  ASSERT_TRUE(mesh);
  for (const Triangle& t : mesh->triangles) {
    const Vec3 a = mesh->vertices[t[1]] - mesh->vertices[t[0]];
    const Vec3 b = mesh->vertices[t[2]] - mesh->vertices[t[0]];
    const Vec3 c = b - a;
    const double longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
    const double height = a.cross(b).norm() / longest;
    EXPECT_GT(height, 0.15 * longest);
    EXPECT_GT(a.cross(b).dot(mesh->vertices[t[0]]), 0) << "faces outwards";
  }
}

}  // namespace
}  // namespace osteon
