#include "measure_wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace osteon {
namespace {

// A strip of triangles about z, over `round_rad` of the way, with the radius r(z).
TriMesh strip(double round_rad, const std::function<double(double)>& radius) {
  constexpr int kRound = 48, kHigh = 12;
  constexpr double kHeight_m = 0.006;
  TriMesh mesh;
  for (int i = 0; i <= kRound; ++i)
    for (int k = 0; k <= kHigh; ++k) {
      const double turn = round_rad * i / kRound, z = kHeight_m * (k / double(kHigh) - 0.5);
      const double r = radius(z);
      mesh.vertices.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
  for (int i = 0; i < kRound; ++i)
    for (int k = 0; k < kHigh; ++k) {
      const auto a = static_cast<std::uint32_t>(i * (kHigh + 1) + k);
      const auto b = a + kHigh + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({b, a + 1, b + 1});
    }
  return mesh;
}

std::optional<measure::Cylinder> fit(const TriMesh& mesh) {
  std::vector<std::uint32_t> patch(mesh.triangles.size());
  std::iota(patch.begin(), patch.end(), 0u);
  return measure::fit_cylinder(measure::Faces(mesh), patch);
}

constexpr double kRadius_m = 0.003, kAllRound = 2 * M_PI;

// As rims make it that are rounded: the wall leans by `lean` rad towards its middle.
double narrowing(double z, double lean) { return kRadius_m + lean * std::abs(z); }

TEST(FitCylinder, NeedsAnAreaAndABend) {
  EXPECT_FALSE(measure::fit_cylinder(measure::Faces(TriMesh{}), {}));
  const auto flat = [](double) { return kRadius_m; };
  EXPECT_FALSE(fit(strip(0.02, flat)));
}

TEST(FitCylinder, FindsACylindersAxisAndRadius) {
  for (const double round_rad : {1.0, 3.0, kAllRound}) {
    const auto found = fit(strip(round_rad, [](double) { return kRadius_m; }));
    ASSERT_TRUE(found) << round_rad;
    EXPECT_NEAR(std::abs(found->axis.z()), 1, 1e-9);
    EXPECT_NEAR(found->radius, kRadius_m, 1e-9);
    EXPECT_LT(found->radial(Vec3::Zero()).norm(), 1e-9);
    EXPECT_LT(found->roundness, 1e-9);
  }
}

// The normals' spread along the axis is then sin(lean)^2, here 2.5e-3.
TEST(FitCylinder, AWallAllRoundMayHaveRoundedRims) {
  const auto found = fit(strip(kAllRound, [](double z) { return narrowing(z, 0.05); }));
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(found->axis.z()), 1, 1e-6);
  EXPECT_NEAR(found->radius, kRadius_m, 0.05 * 0.003);
}

TEST(FitCylinder, ASmallPatchThatBendsBothWaysIsNone) {
  EXPECT_FALSE(fit(strip(0.5, [](double z) { return narrowing(z, 0.05); })));
}

TEST(FitCylinder, AConeIsNone) {
  EXPECT_FALSE(fit(strip(kAllRound, [](double z) { return kRadius_m + std::tan(0.15) * z; })));
}

}  // namespace
}  // namespace osteon
